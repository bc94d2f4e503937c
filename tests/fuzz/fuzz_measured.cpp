// Feeds arbitrary bytes to the reader of measured materials.
#include <cmath>
#include <cstdlib>

#include "measured/measured_file.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const auto require = [](bool condition) {
    if (!condition) std::abort();
  };
  try {
    duet::ByteReader in("fuzz", {data, size});
    const duet::MeasuredTable t = duet::parse_measured(in);
    const size_t views = t.phi.size() * t.theta.size();
    require(views > 0);
    require(t.ndf.values.size() == t.ndf.nodes() && t.sigma.values.size() == t.sigma.nodes());
    require(t.vndf.values.size() == views * t.vndf.nodes());
    require(t.luminance.values.size() == views * t.luminance.nodes());
    require(t.rgb.values.size() == 3 * views * t.rgb.nodes());
    for (const float v : t.vndf.values) require(std::isfinite(v) && v >= 0);
  } catch (const duet::ReadError&) {
  }
  return 0;
}
