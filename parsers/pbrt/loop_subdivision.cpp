// Loop's subdivision surfaces.
#include <cmath>
#include <map>
#include <numbers>

#include "pbrt/shapes.h"

namespace duet::pbrt {

namespace {

using Triangle = std::array<uint32_t, 3>;
using Edge = std::pair<uint32_t, uint32_t>;

Edge edge(uint32_t a, uint32_t b) {
  return a < b ? Edge{a, b} : Edge{b, a};
}

/// The weight of each neighbour of an inner vertex of valence n.
double beta(size_t n) {
  return n == 3 ? 3.0 / 16 : 3.0 / (8.0 * double(n));
}

/// The neighbours of each vertex in their order around it. At a border they run from one border
/// edge to the other.
struct Rings {
  std::vector<std::vector<uint32_t>> ring;
  std::vector<bool> border;

  Rings(size_t vertices, const std::vector<Triangle>& triangles)
      : ring(vertices), border(vertices, false) {
    // For each vertex, from one neighbour to the next one.
    std::vector<std::vector<Edge>> next(vertices);
    for (const Triangle& t : triangles)
      for (size_t i = 0; i < 3; ++i) next[t[i]].push_back({t[(i + 1) % 3], t[(i + 2) % 3]});
    for (size_t v = 0; v < vertices; ++v) walk(next[v], v);
  }

 private:
  void walk(const std::vector<Edge>& steps, size_t v) {
    if (steps.empty()) return;
    const auto find = [&](uint32_t from) {
      for (const Edge& e : steps)
        if (e.first == from) return &e;
      return static_cast<const Edge*>(nullptr);
    };
    const auto is_target = [&](uint32_t n) {
      for (const Edge& e : steps)
        if (e.second == n) return true;
      return false;
    };
    uint32_t start = steps.front().first;
    for (const Edge& e : steps)
      if (!is_target(e.first)) start = e.first, border[v] = true;
    ring[v].push_back(start);
    for (const Edge* e = find(start); e && ring[v].size() <= steps.size(); e = find(e->second)) {
      if (e->second == start) return;
      ring[v].push_back(e->second);
    }
    border[v] = true;
  }
};

/// The vertex moved by its neighbours with these weights.
Point3f smoothed(const std::vector<Point3f>& p, const Rings& rings, uint32_t v, double inner,
                 double outer) {
  const auto& ring = rings.ring[v];
  if (ring.empty()) return p[v];
  const auto mix = [&](const std::vector<uint32_t>& with, double weight) {
    Vector3f sum = (p[v] - Point3f(0)) * float(1 - double(with.size()) * weight);
    for (const uint32_t n : with) sum = sum + (p[n] - Point3f(0)) * float(weight);
    return Point3f(0) + sum;
  };
  if (rings.border[v]) return mix({ring.front(), ring.back()}, outer);
  return mix(ring, inner);
}

/// Across the limit surface, by two tangents. As in pbrt, it looks away from where the corners of
/// the triangles run counter-clockwise.
Normal3f limit_normal(const std::vector<Point3f>& p, const Rings& rings, uint32_t v) {
  const auto& ring = rings.ring[v];
  const size_t n = ring.size();
  if (n < 2) return Normal3f(0, 0, 0);
  Vector3f s(0, 0, 0), t(0, 0, 0);
  const auto at = [&](size_t i) { return p[ring[i]] - Point3f(0); };
  if (!rings.border[v]) {
    for (size_t j = 0; j < n; ++j) {
      const double angle = 2 * std::numbers::pi * double(j) / double(n);
      s = s + at(j) * float(std::cos(angle));
      t = t + at(j) * float(std::sin(angle));
    }
    return normalized_or_zero(Normal3f(cross(t, s)));
  }
  // Along the border, and across it.
  const Vector3f center = p[v] - Point3f(0);
  s = at(n - 1) - at(0);
  if (n == 2) {
    t = at(0) + at(1) - center * 2;
  } else if (n == 3) {
    t = at(1) - center;
  } else if (n == 4) {
    t = at(0) * -1 + at(1) * 2 + at(2) * 2 + at(3) * -1 + center * -2;
  } else {
    const double theta = std::numbers::pi / double(n - 1);
    t = (at(0) + at(n - 1)) * float(std::sin(theta));
    for (size_t k = 1; k + 1 < n; ++k)
      t = t + at(k) * float((2 * std::cos(theta) - 2) * std::sin(double(k) * theta));
    t = t * -1;
  }
  return normalized_or_zero(Normal3f(cross(s, t)));
}

/// One step: each triangle becomes four.
void refine(std::vector<Point3f>& positions, std::vector<Triangle>& triangles) {
  const Rings rings(positions.size(), triangles);
  std::vector<Point3f> result;
  for (uint32_t v = 0; v < positions.size(); ++v) {
    const size_t n = std::max<size_t>(rings.ring[v].size(), 1);
    result.push_back(smoothed(positions, rings, v, beta(n), 1.0 / 8));
  }
  // The vertices opposite to each edge.
  std::map<Edge, std::pair<std::array<uint32_t, 2>, int>> opposite;
  for (const Triangle& t : triangles)
    for (size_t i = 0; i < 3; ++i) {
      auto& [corners, count] = opposite[edge(t[i], t[(i + 1) % 3])];
      if (count < 2) corners[size_t(count)] = t[(i + 2) % 3];
      ++count;
    }
  std::map<Edge, uint32_t> middle;
  for (const auto& [e, across] : opposite) {
    const Vector3f ends = (positions[e.first] - Point3f(0)) + (positions[e.second] - Point3f(0));
    Vector3f p = ends * 0.5f;
    if (across.second == 2)
      p = ends * 0.375f +
          ((positions[across.first[0]] - Point3f(0)) + (positions[across.first[1]] - Point3f(0))) *
              0.125f;
    middle[e] = uint32_t(result.size());
    result.push_back(Point3f(0) + p);
  }
  std::vector<Triangle> finer;
  for (const auto& [a, b, c] : triangles) {
    const uint32_t ab = middle[edge(a, b)], bc = middle[edge(b, c)], ca = middle[edge(c, a)];
    for (const Triangle& t :
         {Triangle{a, ab, ca}, Triangle{ab, b, bc}, Triangle{ca, bc, c}, Triangle{ab, bc, ca}})
      finer.push_back(t);
  }
  positions = std::move(result);
  triangles = std::move(finer);
}

}  // namespace

TriangleMesh subdivide_loop(const std::vector<Point3f>& positions,
                            const std::vector<Triangle>& triangles, int levels) {
  TriangleMesh mesh;
  mesh.positions = positions;
  mesh.triangles = triangles;
  for (int i = 0; i < levels; ++i) refine(mesh.positions, mesh.triangles);
  const Rings rings(mesh.positions.size(), mesh.triangles);
  std::vector<Point3f> limit;
  for (uint32_t v = 0; v < mesh.positions.size(); ++v) {
    const size_t n = std::max<size_t>(rings.ring[v].size(), 1);
    limit.push_back(
        smoothed(mesh.positions, rings, v, 1 / (double(n) + 3 / (8 * beta(n))), 1.0 / 5));
  }
  // Normals follow from the limit positions, as pbrt has it.
  for (uint32_t v = 0; v < limit.size(); ++v) mesh.normals.push_back(limit_normal(limit, rings, v));
  mesh.positions = std::move(limit);
  return mesh;
}

}  // namespace duet::pbrt
