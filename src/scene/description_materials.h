// Materials as plain data: the BSDFs that come with the program, and the place for any other.
#pragma once

#include "scene/bsdfs/adapters.h"
#include "scene/bsdfs/coats.h"
#include "scene/bsdfs/conductor.h"
#include "scene/bsdfs/dielectric.h"
#include "scene/bsdfs/diffuse.h"
#include "scene/bsdfs/hair.h"
#include "scene/bsdfs/layers.h"
#include "scene/bsdfs/measured.h"
#include "scene/bsdfs/passing.h"
#include "scene/bsdfs/plastic.h"
#include "scene/bsdfs/principled.h"
#include "scene/bsdfs/sums.h"
#include "scene/bsdfs/two_lobes.h"

namespace duet {

struct MaterialDescription {
  SourceLocation where;
  Label label;
  MaterialModel model = DiffuseMaterial{};
  static constexpr auto fields() {
    return plain_fields(&MaterialDescription::where, &MaterialDescription::label,
                        &MaterialDescription::model);
  }
};

}  // namespace duet
