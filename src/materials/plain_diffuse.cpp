#include "materials/plain_diffuse.h"

#include "materials/materials.h"
#include "materials/wrappers.h"

namespace duet {

std::optional<DiffuseSurface> as_diffuse(const Material& material) {
  if (const auto* two_sided = dynamic_cast<const TwoSided*>(&material)) {
    const Material* const nested = two_sided->of_both_sides();
    const auto* diffuse = nested ? dynamic_cast<const Diffuse*>(nested) : nullptr;
    if (!diffuse) return std::nullopt;
    return DiffuseSurface{diffuse->reflectance(), true};
  }
  if (const auto* diffuse = dynamic_cast<const Diffuse*>(&material))
    return DiffuseSurface{diffuse->reflectance(), false};
  return std::nullopt;
}

}  // namespace duet
