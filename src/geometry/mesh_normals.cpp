// Vertex normals made from faces: smooth, or smooth with creases.
#include <algorithm>
#include <bit>
#include <cmath>
#include <span>

#include "base/numbering.h"
#include "geometry/mesh.h"
#include "math/angles.h"
#include "math/hash.h"

namespace duet {

namespace {

/// Faces are measured in double precision: the products of single-precision coordinates neither
/// overflow nor vanish there, whatever the scale of the mesh.
struct Vector3d {
  double x, y, z;
};
Vector3d between(const Point3f& a, const Point3f& b) {
  return {double(b.x) - a.x, double(b.y) - a.y, double(b.z) - a.z};
}
double dot(const Vector3d& a, const Vector3d& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
Vector3d cross(const Vector3d& a, const Vector3d& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
double length(const Vector3d& a) {
  return std::sqrt(dot(a, a));
}

/// Zero for a triangle without area.
Normal3f face_normal(const TriangleMesh& mesh, const std::array<uint32_t, 3>& t) {
  const Point3f& p = mesh.positions[t[0]];
  const Vector3d n = cross(between(p, mesh.positions[t[1]]), between(p, mesh.positions[t[2]]));
  const double l = length(n);
  if (!(l > 0)) return Normal3f{};
  return {float(n.x / l), float(n.y / l), float(n.z / l)};
}

// ---- Equality of vertices ---------------------------------------------------------------------

/// The bits of a number, with one zero.
uint32_t bits(float x) {
  return std::bit_cast<uint32_t>(x + 0.0f);
}

enum class CompareNormals { no, yes };

/// A vertex's numbers of an attribute.
std::span<const float> channels(const MeshAttribute& attribute, uint32_t vertex) {
  const size_t n = size_t(attribute.channels);
  return {attribute.data.data() + vertex * n, n};
}

/// Numbers the distinct vertices; `first[number]` is the first vertex of each.
class DistinctVertices {
 public:
  DistinctVertices(const TriangleMesh& mesh, CompareNormals normals)
      : mesh_(mesh),
        normals_(normals == CompareNormals::yes && !mesh.normals.empty()),
        numbering_(mesh.positions.size()) {}

  uint32_t number(uint32_t vertex) {
    const uint32_t n = numbering_.number(
        hash(vertex), [&](uint32_t other) { return equal(vertex, first_[other]); });
    if (n == first_.size()) first_.push_back(vertex);
    return n;
  }
  const std::vector<uint32_t>& first() const { return first_; }

 private:
  uint64_t hash(uint32_t v) const {
    const Point3f& p = mesh_.positions[v];
    uint64_t h = hash_combine(bits(p.x), hash_combine(bits(p.y), bits(p.z)));
    if (!mesh_.uvs.empty())
      h = hash_combine(h, hash_combine(bits(mesh_.uvs[v].x), bits(mesh_.uvs[v].y)));
    if (normals_) {
      const Normal3f& n = mesh_.normals[v];
      h = hash_combine(h, hash_combine(bits(n.x), hash_combine(bits(n.y), bits(n.z))));
    }
    // Without these, vertices that differ only here would all be compared with each other.
    for (const MeshAttribute& attribute : mesh_.attributes)
      if (!attribute.per_face)
        for (float x : channels(attribute, v)) h = hash_combine(h, bits(x));
    return h;
  }
  bool equal(uint32_t a, uint32_t b) const {
    if (!(mesh_.positions[a] == mesh_.positions[b])) return false;
    if (!mesh_.uvs.empty() && !(mesh_.uvs[a] == mesh_.uvs[b])) return false;
    if (normals_ && !(mesh_.normals[a] == mesh_.normals[b])) return false;
    for (const MeshAttribute& attribute : mesh_.attributes) {
      if (attribute.per_face) continue;
      const std::span<const float> x = channels(attribute, a), y = channels(attribute, b);
      if (!std::equal(x.begin(), x.end(), y.begin())) return false;
    }
    return true;
  }

  const TriangleMesh& mesh_;
  bool normals_;
  Numbering numbering_;
  std::vector<uint32_t> first_;
};

template <class T>
void gather(std::vector<T>& values, size_t width, const std::vector<uint32_t>& from) {
  if (values.empty()) return;
  std::vector<T> result;
  result.reserve(from.size() * width);
  for (uint32_t v : from)
    for (size_t c = 0; c < width; ++c) result.push_back(values[v * width + c]);
  values = std::move(result);
}

/// Makes vertex i what vertex `from[i]` was.
void gather_vertices(TriangleMesh& mesh, const std::vector<uint32_t>& from) {
  gather(mesh.positions, 1, from);
  gather(mesh.normals, 1, from);
  gather(mesh.uvs, 1, from);
  for (MeshAttribute& a : mesh.attributes)
    if (!a.per_face) gather(a.data, size_t(a.channels), from);
}

}  // namespace

void compute_vertex_normals(TriangleMesh& mesh) {
  mesh.normals.assign(mesh.positions.size(), Normal3f{});
  for (const auto& t : mesh.triangles) {
    const Point3f p[3] = {mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]};
    const Vector3d e[3] = {between(p[0], p[1]), between(p[1], p[2]), between(p[2], p[0])};
    const Vector3d n = cross(e[0], e[1]);
    const double l = length(n);
    if (!(l > 0)) continue;
    const Normal3f face{float(n.x / l), float(n.y / l), float(n.z / l)};
    // The sine of each corner's angle is this same length, over the product of its two edges.
    const double angle0 = std::atan2(l, -dot(e[2], e[0])), angle1 = std::atan2(l, -dot(e[0], e[1]));
    const double angles[3] = {angle0, angle1, std::max(0.0, double(kPi) - angle0 - angle1)};
    for (int i = 0; i < 3; ++i) mesh.normals[t[i]] = mesh.normals[t[i]] + face * float(angles[i]);
  }
  // Angles, and so the sums, can be as small as a number can be.
  for (Normal3f& n : mesh.normals) n = normalized_or_zero(n);
  mesh.computed_normals = true;
}

void merge_equal_vertices(TriangleMesh& mesh) {
  DistinctVertices distinct(mesh, CompareNormals::yes);
  for (auto& t : mesh.triangles)
    for (uint32_t& v : t) v = distinct.number(v);
  gather_vertices(mesh, distinct.first());
}

void compute_creased_normals(TriangleMesh& mesh, double max_angle) {
  const float threshold = float(std::cos(max_angle * kRadians));
  mesh.normals.clear();
  merge_equal_vertices(mesh);

  // The corners (triangle · 3 + index) of each vertex, in file order.
  std::vector<uint64_t> begin(mesh.positions.size() + 1, 0);
  for (const auto& t : mesh.triangles)
    for (uint32_t v : t) ++begin[v + 1];
  for (size_t v = 1; v < begin.size(); ++v) begin[v] += begin[v - 1];
  std::vector<uint64_t> corners(3 * mesh.triangles.size());
  {
    std::vector<uint64_t> next(begin.begin(), begin.end() - 1);
    for (size_t c = 0; c < corners.size(); ++c) corners[next[mesh.triangles[c / 3][c % 3]]++] = c;
  }

  std::vector<Normal3f> faces;
  faces.reserve(mesh.triangles.size());
  for (const auto& t : mesh.triangles) faces.push_back(face_normal(mesh, t));

  std::vector<uint32_t> from;
  std::vector<Normal3f> leaders;
  for (uint32_t v = 0; v + 1 < begin.size(); ++v) {
    // Each cluster is a new vertex, led by the normal of its first face.
    const size_t first_cluster = from.size();
    leaders.clear();
    for (uint64_t i = begin[v]; i < begin[v + 1]; ++i) {
      const Normal3f& n = faces[corners[i] / 3];
      size_t k = 0;
      while (k < leaders.size() && !(n == leaders[k] || dot(n, leaders[k]) > threshold)) ++k;
      if (k == leaders.size()) {
        leaders.push_back(n);
        from.push_back(v);
      }
      mesh.triangles[corners[i] / 3][corners[i] % 3] = uint32_t(first_cluster + k);
    }
  }
  gather_vertices(mesh, from);
  compute_vertex_normals(mesh);
}

bool has_flat_normals(const TriangleMesh& mesh) {
  constexpr float kSame = 1 - 1e-6f;
  for (const auto& t : mesh.triangles) {
    const Point3f &a = mesh.positions[t[0]], &b = mesh.positions[t[1]], &c = mesh.positions[t[2]];
    const Vector3f n = cross(b - a, c - a);
    const float l = length(n);
    if (l == 0) continue;
    for (const uint32_t v : t)
      if (!(dot(Vector3f(mesh.normals[v]), n) > kSame * l)) return false;
  }
  return true;
}

}  // namespace duet
