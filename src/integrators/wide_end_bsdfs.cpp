#include "integrators/wide_end_bsdfs.h"

#include <algorithm>
#include <numeric>

#include "integrators/wide_conductor.h"
#include "integrators/wide_dielectric.h"
#include "integrators/wide_plastic.h"

namespace duet {

void EvaluateEnds::evaluate(int n, const WideVertices& vertices, EndBsdfs& ends) {
  // A counting sort: first where each material begins, then, as its pairs are placed, where it
  // ends.
  std::fill(ends_.begin(), ends_.end(), 0);
  for (int k = 0; k < n; ++k) ++ends_[size_t(ends.material[k])];
  std::exclusive_scan(ends_.begin(), ends_.end(), ends_.begin(), 0);
  for (int k = 0; k < n; ++k) order_[ends_[size_t(ends.material[k])]++] = k;
  for (size_t m = 0; m < materials_.size(); ++m) {
    const int32_t* const pairs = order_.data() + ends_[m];
    const int count = ends_[m + 1] - ends_[m];
    if (count == 0) continue;
    for (int j = 0; j < count; ++j) {
      glossy_.at[j] = ends.at[pairs[j]];
      glossy_.towards.set(j, ends.towards.vector(pairs[j]));
    }
    std::visit(
        [&](const auto& material) {
          evaluate_glossy(count, material, vertices, glossy_);
          reverse_glossy(count, material, vertices, glossy_);
        },
        materials_[m]);
    for (int j = 0; j < count; ++j) {
      const int k = pairs[j];
      ends.value.set(k, glossy_.value.x[j], glossy_.value.y[j], glossy_.value.z[j]);
      ends.pdf[k] = glossy_.value_pdf[j];
      ends.reverse[k] = glossy_.reverse[j];
    }
  }
}

}  // namespace duet
