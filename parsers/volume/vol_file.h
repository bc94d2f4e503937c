// Reads Mitsuba's volume files (.vol).
#pragma once

#include <string>

#include "media/volume_grid.h"
#include "mesh/byte_reader.h"

namespace duet {

struct VolumeFile {
  VolumeGrid grid;
  /// Whether the values are stored as 32-bit floating-point numbers.
  bool is_float32 = true;
};

/// Version 3, little endian, with values as 32- or 16-bit floating-point numbers, as bytes from 0
/// to 1, or as directions in two bytes. Throws ReadError "file: message". A grid that is returned
/// has nodes, 1, 3 or 6 channels, finite values and a box that is not flat.
VolumeFile read_vol(const std::string& file);
/// The same for an opened file.
VolumeFile parse_vol(ByteReader& in);

}  // namespace duet
