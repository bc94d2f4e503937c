#include "evaluate/report/scene_parts.h"

#include <set>

#include "evaluate/report/description_text.h"
#include "integrators/make_integrator.h"

namespace duet {

SceneParts scene_parts(const SceneDescription& scene) {
  const DescriptionText text(scene);
  SceneParts parts;
  std::set<MaterialId> materials;
  std::set<MediumId> media;
  const auto use = [&](std::optional<MediumId> id) {
    if (id) media.insert(*id);
  };
  for_each_shape(scene, [&](const ShapeDescription& s) {
    if (!std::holds_alternative<InstanceShape>(s.geometry)) materials.insert(s.material);
    use(s.interior), use(s.exterior);
    if (s.emission) parts.lights.push_back(text.area_light(s));
  });
  for (const ShapeDescription& s : scene.shapes) ++parts.shape_kinds[text.shape_kind(s)];
  for (const SensorDescription& s : scene.sensors) use(s.medium);
  for (const LightDescription& l : scene.lights) parts.lights.push_back(text.light(l));
  for (const MaterialId id : materials) parts.bsdfs.push_back({text.name(id), text.material(id)});
  for (const MediumId id : media)
    parts.media.push_back({text.name(id), text.medium(scene.media[size_t(id)])});
  return parts;
}

std::string method_obstacle(const SceneDescription& scene, const std::string& method) {
  try {
    IntegratorDescription i = scene.integrator;
    apply_override(i, {method, {}, {}});
    make_integrator(i);
    Diagnostics diagnostics;
    check_support(scene, i, diagnostics);
    if (!scene.sensors.empty()) check_support(scene.sensors[0], i, diagnostics);
    for (const Diagnostic& d : diagnostics.all())
      if (d.severity == Severity::error) return d.message;
  } catch (const std::invalid_argument& e) {
    return e.what();
  }
  return "";
}

}  // namespace duet
