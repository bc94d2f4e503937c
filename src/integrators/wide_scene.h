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
                                        PrincipledSurface, RoughDielectricSurface>;

struct alignas(64) WideShape {
  /// Empty if points are made by Scene::surface() alone. What it leaves free at its end has the
  /// number, so that all is in one cache line.
  [[no_unique_address]] WideMesh mesh;
  int32_t number = 0;  ///< of the material in WideScene::glossy or WideScene::specular
  const std::vector<const Texture*>* prefetched = nullptr;  ///< what is waited for, or null
  const ColorSlot* textured = nullptr;  ///< the reflectance if it depends on the point, or null
  Spectrum reflectance;                 ///< otherwise
  WideModel model = WideModel::other;
  bool two_sided = false;      ///< see DiffuseSurface; not of WideModel::other
  bool looks_up = false;       ///< at each point: what is `textured`, or how opaque a mask is
  bool transmits : 1 = false;  ///< of WideModel::glossy: scatters to both sides
  /// Of WideModel::glossy: has smooth lobes even where the reflectance is black.
  bool always_smooth : 1 = false;
  bool emits : 1 = false;
  bool perturbed : 1 = false;  ///< below a map of WideScene::maps
  bool masked : 1 = false;     ///< below a mask of WideScene::masks

  /// Whether more than the model decides how points scatter.
  bool is_covered() const { return perturbed || masked; }

  /// The number of the material among those of vertices that are connected in loops: zero for all
  /// that are diffuse.
  int32_t pair_list() const { return model == WideModel::glossy ? 1 + number : 0; }
  /// Whether its points can be first vertices that see those of other paths (WidePixelGroups). What
  /// masks, bump and normal maps do between two points is not known there.
  bool may_be_first() const {
    return !is_covered() && (model == WideModel::diffuse || model == WideModel::glossy);
  }
  /// Whether its points scatter the same towards all first vertices.
  bool may_be_second() const { return !is_covered() && model == WideModel::diffuse; }
};

/// What is done with batches of paths.
enum class WideUse {
  paths,        ///< from the camera, with light samples: WideTracer
  connections,  ///< of sub-paths. Masks, bump and normal maps are WideModel::other
  /// The same with photons that are merged. Points of nearly specular materials are
  /// WideModel::other, too: it depends on the path whether they merge.
  merging,
};

/// A scene, which must outlive this and stand still, as batches of paths see it.
struct WideScene {
  WideScene(const Scene& scene, WideUse use);

  const Scene& scene;
  std::vector<WideShape> shapes;
  std::vector<WideGlossyMaterial> glossy;
  std::vector<SpecularSurface> specular;
  std::vector<std::optional<PerturbedSurface>> maps;  ///< by shapes; empty if no shape has one
  std::vector<const Mask*> masks;                     ///< likewise
  bool has_normals = false;                           ///< whether any mesh has shading normals
  WideLights lights;

 private:
  void set_model(WideShape& w, const Shape& shape, WideUse use);
  /// Whether the material has a loop of its own, which is set then.
  bool set_plain(WideShape& w, const Shape& shape, const Material& material, WideUse use);
  /// Of what lies below a map, if that is diffuse or glossy.
  bool set_perturbed(WideShape& w, const Shape& shape, const Material& material);
  /// Of what lies below a mask, if that has a loop.
  bool set_masked(WideShape& w, const Shape& shape, const Material& material);
  bool set_diffuse(WideShape& w, const Shape& shape, const Material& material);
  bool set_glossy(WideShape& w, const Shape& shape, const Material& material, WideUse use);
  void set_reflectance(WideShape& w, const Shape& shape, const ColorSlot& slot);

  template <class Surface>
  int32_t number_of(const Shape& shape, const Surface& surface, std::vector<Surface>& surfaces);

  using Textures = std::vector<const Texture*>;
  /// The textures of a material that the processor is likely to wait for; null if there are none.
  const Textures* large_textures(uint32_t material);

  std::map<uint32_t, int32_t> numbers_;    ///< WideShape::number by Shape::material
  std::map<uint32_t, Textures> textures_;  ///< likewise
};

}  // namespace duet
