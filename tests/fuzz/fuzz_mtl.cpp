// Feeds arbitrary bytes to the reader of material libraries.
#include <cmath>
#include <cstdlib>

#include "base/diagnostics.h"
#include "mesh/mtl.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  try {
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    for (const duet::MtlMaterial& m : duet::parse_mtl(text, "fuzz")) {
      if (m.name.empty() || m.line < 1) std::abort();
      for (const auto* v : {&m.diffuse, &m.specular, &m.exponent, &m.opacity, &m.bump})
        for (const double x : v->numbers)
          if (!std::isfinite(x)) std::abort();
    }
  } catch (const duet::ReadError&) {
  }
  return 0;
}
