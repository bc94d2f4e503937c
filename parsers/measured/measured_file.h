// Reads measured materials of the RGL database (.bsdf).
#pragma once

#include <string>

#include "materials/measured_table.h"
#include "mesh/byte_reader.h"

namespace duet {

/// A file of Dupuy & Jakob 2018 (https://rgl.epfl.ch/materials): a "tensor file" of named arrays.
/// Spectra become the colours that they have under D65. Throws ReadError "file: message" for
/// anything else. A table that is returned has grids of matching sizes, increasing angles, and
/// values that are finite and, where they are densities, not negative.
MeasuredTable read_measured(const std::string& file);
/// The same for an opened file.
MeasuredTable parse_measured(ByteReader& in);

}  // namespace duet
