// What a texture yields where there is no surface.
#pragma once

#include <optional>

#include "base/diagnostics.h"
#include "math/spectrum.h"
#include "scene/description.h"

namespace duet {

struct TextureValue {
  Spectrum color;
  float number;
};

/// A texture of the description at the texture coordinates (0, 0) and the origin, which is what
/// Mitsuba 3 takes where a volume is asked for. Nothing, with an error in `diagnostics`, if the
/// texture cannot be built or exists on shapes alone.
std::optional<TextureValue> texture_at_origin(const SceneDescription& description, TextureId id,
                                              Diagnostics& diagnostics);

}  // namespace duet
