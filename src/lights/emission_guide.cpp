#include "lights/emission_guide.h"

#include <algorithm>

#include "math/equal_area.h"

namespace duet {

namespace {

/// The share of rays that begin anyhow, as without a guide: what was not learned is not lost. Of
/// the choice of the light, and of its numbers.
constexpr float kUniform = 0.25f;
/// Directions are told apart while so many records are left for each of their halves.
constexpr size_t kRecordsPerLeaf = 256;
constexpr int kDeepest = 24;

}  // namespace

EmissionGuide::EmissionGuide(std::span<const std::unique_ptr<Light>> lights,
                             const LightPicker& unguided, std::vector<Record> records, float most)
    : roots_(lights.size(), kUnguided) {
  const auto by_light = [](const Record& a, const Record& b) { return a.light < b.light; };
  std::stable_sort(records.begin(), records.end(), by_light);
  double all = 0;
  for (const Record& r : records) all += double(r.weight);
  std::vector<float> chosen(lights.size());
  for (uint32_t i = 0; i < lights.size(); ++i) {
    const auto [first, end] =
        std::equal_range(records.begin(), records.end(), Record{i, {}, {}, 0}, by_light);
    double use = 0;
    for (auto r = first; r != end; ++r) use += double(r->weight);
    const float plain = unguided.probability(i);
    // Lights without power begin no sub-paths.
    chosen[i] = all > 0 && plain > 0 ? lerp(float(use / all), plain, kUniform) : plain;
    most_.push_back(is_infinite(lights[i]->kind()) && plain > 0 ? most * plain / chosen[i]
                                                                : INFINITY);
    if (first != end && guided_numbers(*lights[i], {0, 0, 1}, {0, 0, 0}))
      roots_[i] =
          divide({first, end}, {{0, 0}, {1, 1}, 0}, lights[i]->kind() == LightKind::environment);
  }
  picker_ = LightPicker(chosen);
}

std::optional<Point2f> EmissionGuide::guided_numbers(const Light& light, const Vector3f& from,
                                                     const Point3f& through) {
  if (const SceneSphere* sphere = light.entered_sphere()) return sphere->entry(from, through);
  return light.direction_numbers(-from);
}

uint32_t EmissionGuide::divide(std::span<Record> records, const Cell& cell, bool may_divide) {
  const uint32_t index = uint32_t(nodes_.size());
  nodes_.emplace_back();
  if (!may_divide || records.size() < 2 * kRecordsPerLeaf || cell.depth == kDeepest) {
    std::vector<SquareTree::Record> points;
    for (const Record& r : records) points.push_back({r.numbers, r.weight});
    nodes_[index].numbers = uint32_t(numbers_.size());
    numbers_.emplace_back(points, kUniform);
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

const SquareTree& EmissionGuide::numbers(uint32_t root, const Vector3f& from) const {
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
  return numbers_[nodes_[node].numbers];
}

float EmissionGuide::factor(uint32_t index, const Light& light, const Vector3f& from,
                            const Point3f& through) const {
  const uint32_t root = roots_[index];
  if (root == kUnguided) return 1;
  return std::min(numbers(root, from).density(*guided_numbers(light, from, through)), most_[index]);
}

std::optional<EmissionSample> EmissionGuide::emit(uint32_t index, const Light& light,
                                                  const Point2f& position,
                                                  const Point2f& direction) const {
  const uint32_t root = roots_[index];
  if (root == kUnguided) return light.sample_emission(position, direction);
  const SceneSphere* sphere = light.entered_sphere();
  float density = 1;
  std::optional<EmissionSample> e;
  if (sphere) {
    e = light.sample_emission(position, direction);
    if (!e) return e;
    const Vector3f from = -e->ray.direction;
    e->ray = sphere->enter(from, numbers(root, from).sample(position, density));
  } else {
    e = light.sample_emission(position, numbers(root, {}).sample(direction, density));
    if (!e) return e;
  }
  e->density *= std::min(density, most_[index]);
  e->weight *= 1 / density;
  return e;
}

}  // namespace duet
