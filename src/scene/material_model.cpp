#include "scene/material_model.h"

#include <set>

#include "materials/material.h"
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

bool holds(const SceneDescription& scene, MaterialId id,
           const std::function<bool(const MaterialModel&)>& is_such) {
  // Materials may share what is nested in them, so each is looked at once.
  std::set<MaterialId> seen{id};
  std::vector<MaterialId> open{id};
  while (!open.empty()) {
    const MaterialModel& model = scene.materials[size_t(open.back())].model;
    open.pop_back();
    if (is_such(model)) return true;
    for (const MaterialId nested : model.nested())
      if (seen.insert(nested).second) open.push_back(nested);
  }
  return false;
}

bool transmits(const SceneDescription& scene, MaterialId id) {
  return holds(scene, id, [](const MaterialModel& m) { return m.scattering().transmits(); });
}

}  // namespace duet
