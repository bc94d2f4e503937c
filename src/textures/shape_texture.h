// Textures that read the shape they are on, not just its coordinates.
#pragma once

#include <algorithm>
#include <functional>
#include <string>
#include <vector>

#include "textures/texture.h"

namespace duet {

/// Every shape on which such a texture is used must be announced before the first lookup there.
class ShapeTexture : public Texture {
 public:
  /// Announces a shape, whose mesh must stay where it is; `is_mesh` is false for one that has
  /// triangles only because Duet renders it so. Returns what the shape lacks for the texture, as in
  /// "this shape has no …", or "" if nothing.
  virtual std::string add_shape(const Shape& shape, bool is_mesh) = 0;
  /// Whether lookups read an attribute of meshes by this name.
  virtual bool reads_attribute(const std::string&) const { return false; }
};

/// Something for each of a few meshes.
template <class T>
class PerMesh {
 public:
  struct Entry {
    const TriangleMesh* mesh;
    T value;
  };

  void add(const TriangleMesh* mesh, const T& value) {
    const auto at = std::lower_bound(
        entries_.begin(), entries_.end(), mesh,
        [](const Entry& e, const TriangleMesh* m) { return std::less<>()(e.mesh, m); });
    if (at == entries_.end() || at->mesh != mesh) entries_.insert(at, {mesh, value});
  }
  /// Null if there is nothing for the mesh.
  const T* find(const TriangleMesh* mesh) const {
    size_t lower = 0, upper = entries_.size();
    while (upper - lower > 1) {
      const size_t middle = (lower + upper) / 2;
      (std::less<>()(mesh, entries_[middle].mesh) ? upper : lower) = middle;
    }
    return lower < upper && entries_[lower].mesh == mesh ? &entries_[lower].value : nullptr;
  }
  const std::vector<Entry>& entries() const { return entries_; }

 private:
  std::vector<Entry> entries_;  ///< ordered by mesh
};

/// Derivatives by the mesh's texture coordinates, from those by the barycentric ones; zero where
/// the former do not span the triangle. The mesh must have texture coordinates.
Point2f by_texture_coordinates(const TriangleMesh& mesh, uint32_t triangle,
                               const Point2f& by_barycentric);

}  // namespace duet
