#include "lights/emission_guide.h"

#include <algorithm>

#include "math/equal_area.h"

namespace duet {

namespace {

/// The share of rays that enter anywhere, as without a guide: what was not learned is not lost.
constexpr float kUniform = 0.25f;
/// Directions are told apart while so many records are left for each of their halves.
constexpr size_t kRecordsPerLeaf = 256;
constexpr int kDeepest = 24;

}  // namespace

EmissionGuide::EmissionGuide(std::span<const std::unique_ptr<Light>> lights,
                             std::vector<Record> records, float most)
    : most_(most), roots_(lights.size(), kUnguided) {
  const auto by_light = [](const Record& a, const Record& b) { return a.light < b.light; };
  std::stable_sort(records.begin(), records.end(), by_light);
  for (uint32_t i = 0; i < lights.size(); ++i) {
    const auto [first, end] =
        std::equal_range(records.begin(), records.end(), Record{i, {}, {}, 0}, by_light);
    if (!lights[i]->entered_sphere() || first == end) continue;
    roots_[i] =
        divide({first, end}, {{0, 0}, {1, 1}, 0}, lights[i]->kind() == LightKind::environment);
  }
}

uint32_t EmissionGuide::divide(std::span<Record> records, const Cell& cell, bool may_divide) {
  const uint32_t index = uint32_t(nodes_.size());
  nodes_.emplace_back();
  if (!may_divide || records.size() < 2 * kRecordsPerLeaf || cell.depth == kDeepest) {
    std::vector<SquareTree::Record> points;
    for (const Record& r : records) points.push_back({r.entry, r.weight});
    nodes_[index].entries = uint32_t(entries_.size());
    entries_.emplace_back(points, kUniform);
    return index;
  }
  Cell halves[2] = {cell, cell};
  const bool in_y = cell.depth % 2 == 1;
  float Point2f::*const axis = in_y ? &Point2f::y : &Point2f::x;
  for (int k = 0; k < 2; ++k) {
    halves[k].depth = cell.depth + 1;
    halves[k].size.*axis *= 0.5f;
  }
  halves[1].corner.*axis += halves[1].size.*axis;
  const auto middle = std::stable_partition(records.begin(), records.end(), [&](const Record& r) {
    return sphere_to_square_equal_area(r.from).*axis < halves[1].corner.*axis;
  });
  const uint32_t first = divide({records.begin(), middle}, halves[0], true);
  const uint32_t second = divide({middle, records.end()}, halves[1], true);
  nodes_[index].children[0] = first, nodes_[index].children[1] = second;
  return index;
}

const SquareTree& EmissionGuide::entries(uint32_t root, const Vector3f& from) const {
  uint32_t node = root;
  if (nodes_[node].children[0] != 0) {
    Point2f p = sphere_to_square_equal_area(from);
    const auto half = [](float& x) {
      const bool second = x >= 0.5f;
      x = 2 * x - float(second);
      return second;
    };
    for (bool in_y = false; nodes_[node].children[0] != 0; in_y = !in_y)
      node = nodes_[node].children[half(in_y ? p.y : p.x)];
  }
  return entries_[nodes_[node].entries];
}

float EmissionGuide::factor(uint32_t index, const Light& light, const Vector3f& from,
                            const Point3f& through) const {
  const uint32_t root = roots_[index];
  if (root == kUnguided) return 1;
  return std::min(entries(root, from).density(light.entered_sphere()->entry(from, through)), most_);
}

void EmissionGuide::redirect(uint32_t index, const Light& light, const Point2f& position,
                             EmissionSample& emission) const {
  const uint32_t root = roots_[index];
  if (root == kUnguided) return;
  const Vector3f from = -emission.ray.direction;
  float density;
  const Point2f entry = entries(root, from).sample(position, density);
  emission.ray = light.entered_sphere()->enter(from, entry);
  emission.density *= std::min(density, most_);
  emission.weight *= 1 / density;
}

}  // namespace duet
