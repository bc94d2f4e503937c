#include "scene/build.h"

#include "lights/guided_environment.h"
#include "scene/builder.h"
#include "scene/learn_environment.h"
#include "scene/light_media.h"
#include "scene/scene_motion.h"

namespace duet {

std::unique_ptr<Scene> build_scene(SceneDescription description, const BuildOptions& options,
                                   Diagnostics& diagnostics) {
  const auto [open, close] = description.sensors.at(options.sensor).shutter;
  const size_t moving = count_moving(description);
  std::vector<Mover> movers;
  if (moving > 0) movers = take_movers(description, options.sensor);
  const auto builder = std::make_shared<SceneBuilder>(
      std::move(description), options, movers.empty() ? AccelUse::still : AccelUse::moving);
  std::unique_ptr<Scene> scene = builder->build();
  for (const Diagnostic& d : builder->diagnostics().all()) diagnostics.add(d);
  if (scene) scene->features.moving = moving;
  if (scene && !movers.empty())
    scene->motion = std::make_shared<SceneMotion>(builder, std::move(movers), open, close);
  return scene;
}

SceneBuilder::SceneBuilder(SceneDescription description, const BuildOptions& options, AccelUse use)
    : description_(std::move(description)),
      options_(options),
      use_(use),
      made_(std::make_unique<Scene>()),
      scene_(made_.get()),
      textures_(description_.textures.size()),
      materials_(description_.materials.size()),
      volumes_(description_.volumes.size()),
      phases_(description_.phases.size()),
      media_(description_.media.size()) {}

std::unique_ptr<Scene> SceneBuilder::build() {
  read_images();
  height_fields();
  displace_meshes();
  scene_->features = scene_features(description_);
  shapes();
  lights();
  SensorDescription& sensor = description_.sensors.at(options_.sensor);
  scene_->camera = camera(sensor, {sensor.film.width, sensor.film.height});
  if (const uint32_t m = medium(sensor.medium); m != kNone)
    scene_->camera_medium = scene_->media[m].get();
  if (diagnostics_.has_errors()) return nullptr;
  Scene& scene = *scene_;
  if (options_.names) name_things(*options_.names);
  // Shapes are built, and their descriptions may be many.
  if (use_ == AccelUse::still) description_.shapes = std::vector<ShapeDescription>();
  for (const auto& m : scene.materials) scene.has_passable_surfaces |= m->passes_straight();
  scene.skips_passed_surfaces = scene.has_passable_surfaces && scene.features.skips_masks;
  scene.accel = std::make_unique<Accel>(scene.shapes, scene.top, scene.groups, scene.instances,
                                        options_.threads, use_);
  survey();
  guide_environment({sensor.film.width, sensor.film.height});
  return std::move(made_);
}

void SceneBuilder::survey() {
  Scene& scene = *scene_;
  Bounds bounds = scene.accel->bounds();
  scene.outermost_medium = scene.media.empty() ? nullptr : outermost_medium(scene);
  // Light may be scattered there, too.
  if (scene.outermost_medium)
    if (const auto box = scene.outermost_medium->bounds()) bounds.extend(*box);
  scene.camera->surround(bounds.center(), bounds.radius());
  for (const auto& light : scene.lights) light->surround(bounds.center(), bounds.radius());
  scene.light_media.clear();
  // Vacuum, where there are no media.
  if (scene.needs_media_vertices()) scene.light_media.resize(scene.lights.size());
  if (!scene.media.empty())
    for (size_t i = 0; i < scene.lights.size(); ++i)
      scene.light_media[i] = medium_before(scene, *scene.lights[i]);
  scene.emission_picker =
      LightPicker(selection_weights(scene.lights, sampling_weights_, bounds.radius()));
  scene.direct_picker = DirectPicker(scene.lights, sampling_weights_, bounds.radius(),
                                     light_selection(description_.integrator));
}

void SceneBuilder::guide_environment(Point2i film) {
  Scene& scene = *scene_;
  // Portals, which have no sphere, know where they are seen.
  if (!scene.environment || !scene.environment->entered_sphere() || scene.needs_media_vertices() ||
      use_ != AccelUse::still ||
      light_selection(description_.integrator) != LightSelection::automatic)
    return;
  std::optional<EnvironmentGuide> guide = learn_environment(scene, film, options_.threads);
  if (!guide) return;
  std::unique_ptr<Light>& light = scene.lights[scene.environment_index];
  auto guided = std::make_unique<GuidedEnvironment>(
      std::unique_ptr<EnvironmentLight>(static_cast<EnvironmentLight*>(light.release())),
      std::move(*guide));
  scene.environment = guided.get();
  light = std::move(guided);
}

bool SceneBuilder::check_transform(const Matrix4& m, const SourceLocation& where) {
  if (!m.is_finite() || !m.is_affine())
    diagnostics_.error(where, "the transform is not affine");
  else if (!m.inverse())
    diagnostics_.error(where, "the transform cannot be inverted");
  else
    return true;
  return false;
}

}  // namespace duet
