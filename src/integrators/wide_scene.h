// What a batch of paths looks up for each hit, in one cache line per shape.
#pragma once

#include <map>
#include <variant>
#include <vector>

#include "integrators/wide_lights.h"
#include "integrators/wide_mesh.h"
#include "materials/plain_diffuse.h"
#include "textures/texture.h"

namespace duet {

/// Whether paths of a method without media can be traced in batches.
inline bool suits_batches(const Scene& scene) {
  return !scene.motion;
}

/// How points of a shape scatter.
enum class WideModel : uint8_t {
  diffuse,   ///< DiffuseSurface
  glossy,    ///< WideGlossyMaterial
  specular,  ///< SpecularSurface
  other,     ///< path by path, by the code for one
};

/// A material whose points are scattered in a loop of their own.
using WideGlossyMaterial = std::variant<RoughPlasticSurface, RoughConductorSurface, PlasticSurface,
                                        RoughDielectricSurface>;

struct alignas(64) WideShape {
  /// Empty if points are made by Scene::surface() alone. What it leaves free at its end has the
  /// number, so that all is in one cache line.
  [[no_unique_address]] WideMesh mesh;
  int32_t number = 0;  ///< of the material in WideScene::glossy or WideScene::specular
  const Texture* prefetched = nullptr;  ///< what is waited for, or null
  const ColorSlot* textured = nullptr;  ///< the reflectance if it depends on the point, or null
  Spectrum reflectance;                 ///< otherwise
  WideModel model = WideModel::other;
  bool two_sided = false;  ///< see DiffuseSurface; not of WideModel::other
  bool transmits = false;  ///< of WideModel::glossy: scatters to both sides
  bool emits = false;

  /// The number of the material among those of vertices that are connected in loops: zero for all
  /// that are diffuse.
  int32_t pair_list() const { return model == WideModel::glossy ? 1 + number : 0; }
};

/// A scene, which must outlive this and stand still, as batches of paths see it.
struct WideScene {
  /// If photons are merged, points of nearly specular materials are WideModel::other: it depends on
  /// the path whether they merge.
  explicit WideScene(const Scene& scene, bool merges = false);

  const Scene& scene;
  std::vector<WideShape> shapes;
  std::vector<WideGlossyMaterial> glossy;
  std::vector<SpecularSurface> specular;
  bool has_normals = false;  ///< whether any mesh has shading normals
  WideLights lights;

 private:
  void set_model(WideShape& w, const Shape& shape, bool merges);

  std::map<uint32_t, int32_t> numbers_;  ///< WideShape::number by Shape::material
};

}  // namespace duet
