// Light samples of a batch of paths.
#pragma once

#include "integrators/wide_mesh_lights.h"
#include "integrators/wide_state.h"
#include "lights/direct_picker.h"
#include "lights/flat_light.h"
#include "lights/sphere_light.h"
#include "transport/light_starts.h"

namespace duet {

/// A scene's lights as batches of paths see them: choose_light() for many points at once, with the
/// same results bit for bit. Flat lights, spheres and meshes that shine the same everywhere are
/// sampled in loops, the others one by one.
class WideLights {
 public:
  /// `scene` must outlive this and stand still.
  explicit WideLights(const Scene& scene);

  /// `choice` is room for what is chosen.
  void sample(int n, const WidePoints& points, const WideNumbers& numbers, LightChoices& choice,
              WideLightSamples& samples) const;
  /// LightStarts::density() of the paths that leave the lights of the samples towards the points;
  /// only where there are samples.
  void find_emission(int n, const LightStarts& starts, const WidePoints& points,
                     const LightChoices& choice, WideLightSamples& samples) const;

 private:
  void choose(int n, const WidePoints& points, const WideNumbers& numbers,
              LightChoices& choice) const;
  /// Where the choice is one of the spheres.
  void sample_spheres(int n, const WidePoints& points, const WideNumbers& numbers,
                      const LightChoices& choice, WideLightSamples& samples) const;

  const Scene& scene_;
  std::vector<FlatLight> flat_;  ///< by light; of area 0 for those that are none
  bool has_flat_ = false, has_round_ = false;
  std::vector<SphereLight> spheres_;  ///< by light; of radius 0 for those that are none
  bool has_spheres_ = false;
  WideMeshLights meshes_;
  const FlatLight* only_ = nullptr;  ///< the only light, if it is a parallelogram
};

}  // namespace duet
