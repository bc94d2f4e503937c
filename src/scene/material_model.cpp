#include "scene/material_model.h"

#include <algorithm>

#include "materials/bsdf.h"
#include "scene/description.h"

namespace duet {

void MaterialDeleter::operator()(Material* material) const {
  delete material;
}

std::vector<MaterialId> MaterialModel::nested() const {
  std::vector<MaterialId> ids;
  for_each_field([&](const FieldFacts&, const FieldValue& value) {
    if (const auto* id = std::get_if<const MaterialId*>(&value)) ids.push_back(**id);
    if (const auto* shares = std::get_if<const MaterialShares*>(&value))
      for (const auto& [weight, id] : **shares) ids.push_back(id);
  });
  return ids;
}

bool transmits(const SceneDescription& scene, MaterialId id) {
  const MaterialModel& model = scene.materials[size_t(id)].model;
  if (model.scattering().transmits()) return true;
  const std::vector<MaterialId> nested = model.nested();
  return std::any_of(nested.begin(), nested.end(),
                     [&](MaterialId n) { return transmits(scene, n); });
}

}  // namespace duet
