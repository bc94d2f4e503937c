// What the readers of mesh shapes share.
#pragma once

#include "mesh/mesh_file.h"
#include "mitsuba/properties.h"

namespace duet {

/// The parameters that all mesh files have; `source` gets them, too.
MeshOptions mesh_options(Properties& p, MeshSource& source);

}  // namespace duet
