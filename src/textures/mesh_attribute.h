// Values stored with the vertices or faces of a mesh.
#pragma once

#include <string>

#include "textures/shape_texture.h"

namespace duet {

/// An attribute of the mesh that is hit, times a scale: interpolated between vertices, or constant
/// on each face.
class MeshAttributeMap final : public ShapeTexture {
 public:
  MeshAttributeMap(std::string attribute, float scale);

  std::string add_shape(const Shape& shape, bool is_mesh) override;
  bool reads_attribute(const std::string& name) const override { return name == attribute_; }

  Spectrum color(const Surface& s) const override;
  float value(const Surface& s) const override;
  /// By the mesh's texture coordinates; zero if it has none.
  Point2f gradient(const Surface& s) const override;
  Spectrum average() const override;
  bool needs_uv() const override { return false; }

 private:
  const MeshAttribute& find(const Surface& s) const { return **data_.find(s.shape->mesh.get()); }
  Spectrum color(const MeshAttribute& data, const Surface& s) const;
  /// The value at a vertex or on a face.
  Spectrum element(const MeshAttribute& data, uint32_t index) const;

  std::string attribute_;
  float scale_;
  PerMesh<const MeshAttribute*> data_;
};

}  // namespace duet
