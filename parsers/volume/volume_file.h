// Volume files of every format, told apart by their names.
#pragma once

#include <string>

#include "math/transform.h"
#include "volume/vol_file.h"

namespace duet {

/// Whether the name is that of a NanoVDB file (.nvdb), which Mitsuba does not read. The outermost
/// nodes of its grid lie on the faces of its box.
bool is_nanovdb(const std::string& file);

/// Of a NanoVDB file the grid called "density"; its box must lie along the axes. Any other file is
/// read as a .vol file. Throws ReadError "file: message".
VolumeFile read_volume(const std::string& file);

/// From the unit cube to the box that the file says the grid fills.
Matrix4 box_to_world(const VolumeGrid& grid);

}  // namespace duet
