// Writes curves as Mitsuba 3 reads them.
#pragma once

#include <string>

#include "geometry/curves.h"

namespace duet {

/// A text with a point and its radius per line and an empty line between curves. Segments that
/// follow one another are one curve; read_curves() yields the same segments.
std::string curves_text(const CurveSet& curves);

}  // namespace duet
