// Values stored with the vertices or faces of a mesh.
#pragma once

#include <string>
#include <vector>

#include "textures/texture.h"

namespace duet {

/// An attribute of the mesh that is hit, times a scale: interpolated between vertices, or constant
/// on each face. Every mesh on which the texture is used must be announced first.
class MeshAttributeMap final : public Texture {
 public:
  MeshAttributeMap(std::string attribute, float scale);

  /// Announces a mesh; false if it has no such attribute. The mesh must stay where it is.
  bool add_mesh(const TriangleMesh& mesh);
  const std::string& attribute() const { return attribute_; }

  Spectrum color(const Surface& s) const override;
  float value(const Surface& s) const override;
  /// By the mesh's texture coordinates; zero if it has none.
  Point2f gradient(const Surface& s) const override;
  Spectrum average() const override;
  float maximum() const override;
  bool needs_uv() const override { return false; }

 private:
  struct Entry {
    const TriangleMesh* mesh;
    const MeshAttribute* data;
  };
  const Entry& find(const Surface& s) const;
  Spectrum color(const Entry& e, const Surface& s) const;
  /// The value at a vertex or on a face.
  Spectrum element(const MeshAttribute& data, uint32_t index) const;

  std::string attribute_;
  float scale_;
  std::vector<Entry> entries_;  ///< ordered by mesh
};

}  // namespace duet
