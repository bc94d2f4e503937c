#include "curves/curves_writer.h"

#include <fmt/format.h>

namespace duet {

std::string curves_text(const CurveSet& curves) {
  std::string out;
  const uint32_t length = points_per_segment(curves.kind);
  uint32_t next = 0;  // the point that the curve goes on with
  for (const uint32_t segment : curves.segments) {
    const bool goes_on = !out.empty() && segment + length == next + 1;
    if (!goes_on && !out.empty()) out += '\n';
    for (uint32_t i = goes_on ? length - 1 : 0; i < length; ++i) {
      const TubePoint& t = curves.points[segment + i];
      out += fmt::format("{} {} {} {}\n", t.position.x, t.position.y, t.position.z, t.radius);
    }
    next = segment + length;
  }
  return out;
}

}  // namespace duet
