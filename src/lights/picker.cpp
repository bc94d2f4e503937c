#include "lights/picker.h"

#include <array>

namespace duet {

std::vector<float> selection_weights(std::span<const std::unique_ptr<Light>> lights,
                                     std::span<const double> factors, double scene_radius) {
  constexpr double kEqualShare = 0.5;
  const size_t n = lights.size();
  std::vector<double> power(n);
  std::array<double, 2> total{};
  double shining = 0;
  for (size_t i = 0; i < n; ++i) {
    const size_t kind = is_infinite(lights[i]->kind());
    power[i] = lights[i]->power(scene_radius);
    total[kind] += power[i];
    shining += power[i] > 0;
  }
  const double of_kind = total[0] > 0 && total[1] > 0 ? 0.5 : 1;
  std::vector<float> weights(n);
  for (size_t i = 0; i < n; ++i) {
    if (!(power[i] > 0)) continue;
    const size_t kind = is_infinite(lights[i]->kind());
    const double by_power = of_kind * power[i] / total[kind];
    const double share = (1 - kEqualShare) * by_power + kEqualShare / shining;
    weights[i] = float(share * factors[i]);
  }
  return weights;
}

}  // namespace duet
