#include "textures/mesh_attribute.h"

#include <algorithm>
#include <functional>

namespace duet {

MeshAttributeMap::MeshAttributeMap(std::string attribute, float scale)
    : attribute_(std::move(attribute)), scale_(scale) {}

bool MeshAttributeMap::add_mesh(const TriangleMesh& mesh) {
  const MeshAttribute* data = mesh.find_attribute(attribute_);
  if (!data) return false;
  const auto at = std::lower_bound(
      entries_.begin(), entries_.end(), &mesh,
      [](const Entry& e, const TriangleMesh* m) { return std::less<>()(e.mesh, m); });
  if (at == entries_.end() || at->mesh != &mesh) entries_.insert(at, {&mesh, data});
  return true;
}

const MeshAttributeMap::Entry& MeshAttributeMap::find(const Surface& s) const {
  const TriangleMesh* mesh = s.shape->mesh.get();
  size_t lower = 0, upper = entries_.size();
  while (upper - lower > 1) {
    const size_t middle = (lower + upper) / 2;
    (std::less<>()(mesh, entries_[middle].mesh) ? upper : lower) = middle;
  }
  return entries_[lower];
}

Spectrum MeshAttributeMap::element(const MeshAttribute& data, uint32_t index) const {
  if (data.channels == 1) return Spectrum(data.data[index] * scale_);
  const float* p = &data.data[3 * size_t(index)];
  return Spectrum(p[0], p[1], p[2]) * scale_;
}

Spectrum MeshAttributeMap::color(const Entry& e, const Surface& s) const {
  if (e.data->per_face) return element(*e.data, s.primitive);
  const auto& t = e.mesh->triangles[s.primitive];
  const Point2f& b = s.barycentric;
  return element(*e.data, t[0]) * (1 - b.x - b.y) + element(*e.data, t[1]) * b.x +
         element(*e.data, t[2]) * b.y;
}

Spectrum MeshAttributeMap::color(const Surface& s) const {
  return color(find(s), s);
}

float MeshAttributeMap::value(const Surface& s) const {
  const Entry& e = find(s);
  const Spectrum c = color(e, s);
  return e.data->channels == 1 ? c.r : c.luminance();
}

Point2f MeshAttributeMap::gradient(const Surface& s) const {
  const Entry& e = find(s);
  if (e.data->per_face || e.mesh->uvs.empty()) return {0, 0};
  const auto& t = e.mesh->triangles[s.primitive];
  const auto number = [&](int i) { return element(*e.data, t[size_t(i)]).luminance(); };
  const float f1 = number(1) - number(0), f2 = number(2) - number(0);
  const Point2f a = e.mesh->uvs[t[1]] - e.mesh->uvs[t[0]],
                b = e.mesh->uvs[t[2]] - e.mesh->uvs[t[0]];
  const float det = a.x * b.y - a.y * b.x;
  if (det == 0) return {0, 0};
  return {(f1 * b.y - f2 * a.y) / det, (f2 * a.x - f1 * b.x) / det};
}

Spectrum MeshAttributeMap::average() const {
  double sum[3] = {0, 0, 0};
  size_t n = 0;
  for (const Entry& e : entries_) {
    const uint32_t count = uint32_t(e.data->data.size() / size_t(e.data->channels));
    for (uint32_t i = 0; i < count; ++i) {
      const Spectrum c = element(*e.data, i);
      for (int k = 0; k < 3; ++k) sum[k] += c[k];
    }
    n += count;
  }
  if (n == 0) return {};
  return {float(sum[0] / double(n)), float(sum[1] / double(n)), float(sum[2] / double(n))};
}

float MeshAttributeMap::maximum() const {
  float m = 0;
  for (const Entry& e : entries_)
    for (const float v : e.data->data) m = std::max(m, v * scale_);
  return m;
}

}  // namespace duet
