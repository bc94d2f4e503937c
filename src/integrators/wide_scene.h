// What a batch of paths looks up for each hit, in one cache line per shape.
#pragma once

#include <vector>

#include "integrators/wide_lights.h"
#include "textures/texture.h"

namespace duet {

struct alignas(64) WideShape {
  const Point3f* positions = nullptr;  ///< null if points are made by Scene::surface() alone
  const std::array<uint32_t, 3>* triangles = nullptr;
  const Normal3f* normals = nullptr;        ///< or null
  const Texture* prefetched = nullptr;      ///< Material::main_texture() if not `diffuse`
  const ColorSlot* textured = nullptr;      ///< the reflectance if it depends on the point, or null
  Spectrum reflectance;                     ///< otherwise
  float sign = 1;                           ///< −1 if the normals are to be turned
  bool diffuse = false, two_sided = false;  ///< see DiffuseSurface
  bool emits = false;
};

/// A scene, which must outlive this and stand still, as batches of paths see it.
struct WideScene {
  explicit WideScene(const Scene& scene);

  const Scene& scene;
  std::vector<WideShape> shapes;
  bool has_normals = false;  ///< whether any mesh has shading normals
  WideLights lights;
};

}  // namespace duet
