// Feeds arbitrary bytes to the readers of curves and hair.
#include <cmath>
#include <cstdlib>

#include "curves/curve_file.h"

namespace {

void require(bool condition) {
  if (!condition) std::abort();
}

void check(const duet::CurveSet& curves) {
  require(!curves.segments.empty());
  const size_t need = duet::points_per_segment(curves.kind);
  for (const uint32_t s : curves.segments) require(s + need <= curves.points.size());
  for (const duet::TubePoint& p : curves.points) {
    require(std::isfinite(p.position.x) && std::isfinite(p.position.y));
    require(std::isfinite(p.position.z) && p.radius >= 0 && std::isfinite(p.radius));
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  for (const duet::CurveKind kind : {duet::CurveKind::linear, duet::CurveKind::bspline}) try {
      duet::ByteReader in("fuzz", {data, size});
      check(duet::parse_curves(in, kind));
    } catch (const duet::ReadError&) {
    }
  try {
    duet::ByteReader in("fuzz", {data, size});
    check(duet::parse_hair(in, 0.1f));
  } catch (const duet::ReadError&) {
  }
  return 0;
}
