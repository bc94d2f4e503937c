#include "integrators/importance_map.h"

#include <algorithm>
#include <array>

#include "base/parallel.h"

namespace duet {

namespace {

constexpr uint64_t kImportonSeed = 0x696d706f7274ull;
constexpr size_t kImportonSubpathsPerBlock = 64;
constexpr size_t kImportonsPerLeaf = 8;
/// How far apart opposite normals are, in parts of the extent of all importons.
constexpr float kNormalScale = 0.05f;
/// Boxes are so much larger on each side, in parts of their diagonal: what lies between importons
/// matters, too.
constexpr float kMargin = 0.25f;

void trace_importons(const Scene& scene, const Ray& camera_ray, int max_depth,
                     const SubpathOptions& options, Sampler& sampler,
                     std::vector<Importon>& importons) {
  const TechniqueSet set;
  Subpath subpath;
  subpath.ray = camera_ray;
  subpath.from = camera_ray.origin;
  subpath.throughput = Spectrum(1);
  Hit hit;
  for (int depth = 1; depth <= max_depth && scene.accel->closest_hit(subpath.ray, hit); ++depth) {
    const Surface s = scene.surface(subpath.ray, hit);
    const PathVertex v(scene, s, -subpath.ray.direction, subpath.throughput, Partials{}, depth);
    const bool one_sided = !scene.materials[s.shape->material]->transmits();
    const float side = dot(s.ng, v.wo) < 0 ? -1.0f : 1.0f;
    importons.push_back({v.position(), one_sided ? Vector3f(s.ng) * side : Vector3f(0),
                         std::min(v.throughput.max(), 1.0f), v.is_smooth()});
    if (!scatter<Transport::radiance>(v, set, options, sampler, subpath)) return;
  }
}

using Coordinates = std::array<float, 6>;
Coordinates coordinates(const Importon& i, float normal_scale) {
  const Vector3f n = i.normal * normal_scale;
  return {i.position.x, i.position.y, i.position.z, n.x, n.y, n.z};
}

}  // namespace

std::vector<Importon> trace_importons(const Scene& scene, Point2i film, int side, int max_depth,
                                      const SubpathOptions& options, int threads) {
  return parallel_append<Importon>(
      size_t(side) * size_t(side), kImportonSubpathsPerBlock, threads,
      [&](size_t i, std::vector<Importon>& importons) {
        Sampler sampler(SampleSequence::independent, kImportonSeed, 0, i);
        sampler.start_sample(0);
        const Point2f jitter = sampler.next_2d();
        const Point2f at{(float(i % size_t(side)) + jitter.x) / float(side) * float(film.x),
                         (float(i / size_t(side)) + jitter.y) / float(side) * float(film.y)};
        const Ray ray = scene.camera->sample_ray(at, sampler.next_2d());
        trace_importons(scene, ray, max_depth, options, sampler, importons);
      });
}

ImportanceMap::ImportanceMap(std::vector<Importon> importons) {
  std::erase_if(importons, [](const Importon& i) { return !i.is_smooth; });
  if (importons.empty()) return;
  Bounds bounds;
  for (const Importon& i : importons) bounds.extend(i.position);
  build(importons, kNormalScale * bounds.radius());
}

void ImportanceMap::build(std::span<Importon> importons, float normal_scale) {
  const size_t index = nodes_.size();
  nodes_.emplace_back();
  Coordinates low, high;
  low.fill(INFINITY), high.fill(-INFINITY);
  Vector3f normal(0);
  float weight = 0;
  for (const Importon& i : importons) {
    const Coordinates c = coordinates(i, normal_scale);
    for (size_t k = 0; k < c.size(); ++k)
      low[k] = std::min(low[k], c[k]), high[k] = std::max(high[k], c[k]);
    normal = normal + i.normal;
    weight += i.weight;
  }
  size_t axis = 0;
  for (size_t k = 1; k < low.size(); ++k)
    if (high[k] - low[k] > high[axis] - low[axis]) axis = k;
  const Vector3f size{high[0] - low[0], high[1] - low[1], high[2] - low[2]};
  const Vector3f margin = Vector3f(1) * (kMargin * length(size));
  Node node{Point3f(low[0], low[1], low[2]) - margin, Point3f(high[0], high[1], high[2]) + margin,
            normal, 0};
  if (importons.size() > kImportonsPerLeaf && high[axis] > low[axis]) {
    const auto middle = importons.begin() + ptrdiff_t(importons.size() / 2);
    std::nth_element(
        importons.begin(), middle, importons.end(), [&](const Importon& a, const Importon& b) {
          return coordinates(a, normal_scale)[axis] < coordinates(b, normal_scale)[axis];
        });
    build({importons.begin(), middle}, normal_scale);
    build({middle, importons.end()}, normal_scale);
  } else {
    // The largest side of the box stands for the surface in it.
    const Vector3f s = node.high - node.low;
    const float area = std::max({s.x * s.y, s.y * s.z, s.z * s.x});
    node.is_leaf = true;
    node.importance = area > 0 ? weight / area : 0.0f;
  }
  node.skip = uint32_t(nodes_.size());
  nodes_[index] = node;
}

float ImportanceMap::operator()(const Point3f& p, const Vector3f& wi) const {
  float sum = 0;
  for (uint32_t i = 0; i < nodes_.size();) {
    const Node& n = nodes_[i];
    const bool inside = p.x >= n.low.x && p.y >= n.low.y && p.z >= n.low.z && p.x <= n.high.x &&
                        p.y <= n.high.y && p.z <= n.high.z;
    if (inside && n.is_leaf && (dot(n.normal, wi) > 0 || length_squared(n.normal) == 0))
      sum += n.importance;
    i = inside && !n.is_leaf ? i + 1 : n.skip;
  }
  return sum;
}

}  // namespace duet
