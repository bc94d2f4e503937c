// Reads the points of hair and other curves from files.
#pragma once

#include <string>

#include "geometry/curves.h"
#include "mesh/byte_reader.h"

namespace duet {

/// Mitsuba 3's curves: one point per line, as position and radius (what follows on the line does
/// not count); an empty line ends a curve. Throws ReadError "file:line: message" for what is no
/// number, for a curve with too few points for its kind and a file without any, for radii that are
/// negative and numbers that are not finite.
CurveSet read_curves(const std::string& file, CurveKind kind);
/// The same for an opened file.
CurveSet parse_curves(ByteReader& in, CurveKind kind);

/// The hair of Mitsuba 0.6, all of one radius: a text with one position per line and an empty line
/// between hairs, or a binary file. Hairs of a single point are left out. Throws ReadError.
CurveSet read_hair(const std::string& file, float radius);
/// The same for an opened file.
CurveSet parse_hair(ByteReader& in, float radius);

}  // namespace duet
