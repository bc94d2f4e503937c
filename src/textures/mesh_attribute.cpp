#include "textures/mesh_attribute.h"

namespace duet {

MeshAttributeMap::MeshAttributeMap(std::string attribute, float scale)
    : attribute_(std::move(attribute)), scale_(scale) {}

std::string MeshAttributeMap::add_shape(const Shape& shape, bool) {
  const MeshAttribute* data = shape.mesh ? shape.mesh->find_attribute(attribute_) : nullptr;
  if (!data) return "attribute \"" + attribute_ + "\"";
  data_.add(shape.mesh.get(), data);
  return "";
}

Spectrum MeshAttributeMap::element(const MeshAttribute& data, uint32_t index) const {
  if (data.channels == 1) return Spectrum(data.data[index] * scale_);
  const float* p = &data.data[3 * size_t(index)];
  return Spectrum(p[0], p[1], p[2]) * scale_;
}

Spectrum MeshAttributeMap::color(const MeshAttribute& data, const Surface& s) const {
  if (data.per_face) return element(data, s.primitive);
  const auto& t = s.shape->mesh->triangles[s.primitive];
  const Point2f& b = s.barycentric;
  return element(data, t[0]) * (1 - b.x - b.y) + element(data, t[1]) * b.x +
         element(data, t[2]) * b.y;
}

Spectrum MeshAttributeMap::color(const Surface& s) const {
  return color(find(s), s);
}

float MeshAttributeMap::value(const Surface& s) const {
  const MeshAttribute& data = find(s);
  const Spectrum c = color(data, s);
  return data.channels == 1 ? c.r : c.luminance();
}

Point2f MeshAttributeMap::gradient(const Surface& s) const {
  const MeshAttribute& data = find(s);
  const TriangleMesh& mesh = *s.shape->mesh;
  if (data.per_face || mesh.uvs.empty()) return {0, 0};
  const auto& t = mesh.triangles[s.primitive];
  const auto number = [&](int i) { return element(data, t[size_t(i)]).luminance(); };
  return by_texture_coordinates(mesh, s.primitive, {number(1) - number(0), number(2) - number(0)});
}

Spectrum MeshAttributeMap::average() const {
  double sum[3] = {0, 0, 0};
  size_t n = 0;
  for (const auto& [mesh, data] : data_.entries()) {
    const uint32_t count = uint32_t(data->data.size() / size_t(data->channels));
    for (uint32_t i = 0; i < count; ++i) {
      const Spectrum c = element(*data, i);
      for (int k = 0; k < 3; ++k) sum[k] += c[k];
    }
    n += count;
  }
  if (n == 0) return {};
  return {float(sum[0] / double(n)), float(sum[1] / double(n)), float(sum[2] / double(n))};
}

}  // namespace duet
