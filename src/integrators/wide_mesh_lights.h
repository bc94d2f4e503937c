// Light samples of meshes for a batch of paths.
#pragma once

#include <vector>

#include "integrators/wide_mesh.h"
#include "lights/area.h"
#include "lights/direct_picker.h"

namespace duet {

/// Light samples one after the other, whatever points they belong to.
struct ListedLightSamples {
  BatchArray<int32_t> at;  ///< number of the point
  BatchTriples wi, target, weight;
  BatchArray<float> pdf;  ///< 0 without a sample

  /// A sample of a light with the density `density` per solid angle.
  [[gnu::always_inline]] void set(int k, const Vector3f& direction, const Point3f& end,
                                  const Spectrum& radiance, float density) {
    const float inverse = 1 / density;
    wi.set(k, direction);
    target.set(k, end);
    weight.set(k, radiance.r * inverse, radiance.g * inverse, radiance.b * inverse);
    pdf[k] = density;
  }
  /// To the samples of all points; `emission` is LightSample::emission.
  void copy(int k, float emission, const LightChoices& choice, WideLightSamples& out) const {
    const int i = at[k];
    const float probability = choice.probability[i];
    out.wi.set(i, wi.vector(k));
    out.target.set(i, target.point(k));
    out.weight.set(i, weight.x[k], weight.y[k], weight.z[k]);
    out.pdf[i] = pdf[k] > 0 ? pdf[k] * probability : -1.0f;
    out.probability[i] = probability;
    out.finite[i] = 1;
    out.delta[i] = 0;
    out.emission[i] = emission;
  }
};

struct MeshLightRoom;

/// Those lights of a scene that are meshes and shine the same everywhere.
class WideMeshLights {
 public:
  /// The next light, of any kind; it must outlive this.
  void add(const Light& light);
  /// Whether a light, by its number, is one of them.
  bool has(uint32_t light) const { return sources_[light].points != nullptr; }
  /// Sets the samples of points for which one of them was chosen.
  void sample(int n, const WidePoints& points, const WideNumbers& numbers,
              const LightChoices& choice, WideLightSamples& samples) const;

 private:
  struct Source {
    const EmissiveMesh* points = nullptr;
    WideMesh mesh;
  };
  int choose(int n, const WidePoints& points, const WideNumbers& numbers,
             const LightChoices& choice, MeshLightRoom& room) const;
  void fetch(int count, const LightChoices& choice, MeshLightRoom& room) const;

  std::vector<Source> sources_;    ///< by light
  std::vector<MeshLight> lights_;  ///< by light
  bool any_ = false, smooth_ = false;
};

}  // namespace duet
