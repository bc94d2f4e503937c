// The scene as plain data: what every parser yields and what build() makes a Scene of.
//
// A description has one meaning, whatever file version it came from: colours are linear sRGB,
// parameters have their names and units of Mitsuba 3, references are indices, meshes are loaded.
// Two descriptions compare equal if they describe the same scene; places and names do not count.
#pragma once

#include <string>
#include <vector>

#include "scene/description_integrators.h"
#include "scene/description_lights.h"
#include "scene/description_materials.h"
#include "scene/description_media.h"
#include "scene/description_sensors.h"
#include "scene/description_textures.h"

namespace duet {

struct SceneDescription {
  std::string file;  ///< the main file
  std::vector<TextureDescription> textures;
  std::vector<MaterialDescription> materials;
  std::vector<VolumeDescription> volumes;
  std::vector<PhaseDescription> phases;
  std::vector<MediumDescription> media;
  std::vector<ShapeDescription> shapes;
  std::vector<ShapeGroupDescription> groups;
  std::vector<LightDescription> lights;
  std::vector<SensorDescription> sensors;
  IntegratorDescription integrator;
  /// Whether surfaces that light passes straight through count as vertices of paths, whose depth
  /// they add to, and stop light samples: so in Mitsuba, but for its volpath, and not in pbrt.
  bool counts_passed_surfaces = true;
  /// What is rendered differently from what the file asks for, one sentence each.
  std::vector<Diagnostic> approximations;

  /// The special members are compiled once, and not by all that describe or read scenes.
  SceneDescription();
  SceneDescription(const SceneDescription&);
  SceneDescription(SceneDescription&&) noexcept;
  SceneDescription& operator=(const SceneDescription&);
  SceneDescription& operator=(SceneDescription&&) noexcept;
  ~SceneDescription();

  /// Of what is compared, the order of things counts.
  static constexpr auto fields() {
    using S = SceneDescription;
    return plain_fields(&S::textures, &S::materials, &S::volumes, &S::phases, &S::media, &S::shapes,
                        &S::groups, &S::lights, &S::sensors, &S::integrator,
                        &S::counts_passed_surfaces);
  }
};

/// Gives the shapes of the scene to `visit`, and then those of its groups. The scene may be const.
template <class Scene, class Visit>
void for_each_shape(Scene& scene, Visit visit) {
  for (auto& s : scene.shapes) visit(s);
  for (auto& group : scene.groups)
    for (auto& s : group.shapes) visit(s);
}

/// The number of shapes, lights and sensors that move.
size_t count_moving(const SceneDescription& scene);
/// The scene as it stands at a time. Nothing in it moves.
SceneDescription scene_at(SceneDescription scene, double time);

}  // namespace duet
