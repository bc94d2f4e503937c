// Writes Mitsuba's volume files (.vol).
#pragma once

#include <string>

#include "media/volume_grid.h"

namespace duet {

/// Version 3 with 32-bit floating-point numbers; read_vol() yields the grid again.
std::string vol_bytes(const VolumeGrid& grid);

}  // namespace duet
