#include "geometry/edge_splitting.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <utility>

namespace duet {

namespace {

/// The vertices in the middle of edges that were split.
class Middles {
 public:
  explicit Middles(TriangleMesh& mesh) : mesh_(mesh) {}

  uint32_t of(uint32_t a, uint32_t b) {
    const uint64_t edge = uint64_t(std::min(a, b)) << 32 | std::max(a, b);
    const auto [entry, is_new] = vertices_.try_emplace(edge, uint32_t(mesh_.positions.size()));
    if (!is_new) return entry->second;
    const auto mean = [](const auto& p, const auto& q) { return p + (q - p) * 0.5f; };
    mesh_.positions.push_back(mean(mesh_.positions[a], mesh_.positions[b]));
    if (!mesh_.uvs.empty()) mesh_.uvs.push_back(mean(mesh_.uvs[a], mesh_.uvs[b]));
    if (!mesh_.normals.empty())
      mesh_.normals.push_back(normalized_or_zero(mesh_.normals[a] + mesh_.normals[b]));
    return entry->second;
  }

 private:
  TriangleMesh& mesh_;
  std::unordered_map<uint64_t, uint32_t> vertices_;
};

/// A number of triangles with edges shorter than `length` that is too few to cover the mesh: none
/// of them is larger than one of three such edges.
double too_few_triangles(const TriangleMesh& mesh, const Transform& place, double length) {
  double area = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Point3f p = place(mesh.positions[a]);
    area += 0.5 *
            double(duet::length(cross(place(mesh.positions[b]) - p, place(mesh.positions[c]) - p)));
  }
  // Midpoints are rounded.
  return 0.99 * area / (std::sqrt(3.0) / 4 * length * length);
}

}  // namespace

bool split_long_edges(TriangleMesh& mesh, const Matrix4& to_world, double length, size_t most) {
  mesh.attributes.clear();
  const Transform place(to_world);
  // It would take minutes and gigabytes to find out.
  if (too_few_triangles(mesh, place, length) > double(most)) return false;
  const auto edge_length = [&](uint32_t a, uint32_t b) {
    return double(duet::length(place(mesh.positions[b]) - place(mesh.positions[a])));
  };
  Middles middles(mesh);
  std::vector<std::array<uint32_t, 3>> waiting = std::exchange(mesh.triangles, {});
  std::reverse(waiting.begin(), waiting.end());
  while (!waiting.empty()) {
    const std::array<uint32_t, 3> t = waiting.back();
    waiting.pop_back();
    const std::array<double, 3> lengths{edge_length(t[0], t[1]), edge_length(t[1], t[2]),
                                        edge_length(t[2], t[0])};
    const size_t longest =
        size_t(std::max_element(lengths.begin(), lengths.end()) - lengths.begin());
    if (!(lengths[longest] >= length)) {
      mesh.triangles.push_back(t);
      continue;
    }
    const uint32_t a = t[longest], b = t[(longest + 1) % 3], c = t[(longest + 2) % 3],
                   middle = middles.of(a, b);
    waiting.push_back({middle, b, c});
    waiting.push_back({a, middle, c});
    if (waiting.size() + mesh.triangles.size() > most) return false;
  }
  return true;
}

}  // namespace duet
