#include "lights/triangle_cells.h"

#include <algorithm>

#include "math/warp.h"

namespace duet {

namespace {

constexpr double kMaxCells = 1 << 17;
/// Bilinear interpolation has slopes within a texel.
constexpr double kCellsPerTexel = 16;
constexpr int kMinPoints = 4, kMaxPoints = 64;
/// Share of the probability that is spread evenly over the area.
constexpr double kEvenCellShare = 0.02;

/// Points of the unit square that fill it evenly.
/// Source: Roberts, "The Unreasonable Effectiveness of Quasirandom Sequences", 2018.
Point2f even_point(int i) {
  const double x = 0.5 + 0.7548776662466927 * i, y = 0.5 + 0.5698402909980532 * i;
  return {float(x - std::floor(x)), float(y - std::floor(y))};
}

}  // namespace

TriangleCells::TriangleCells(const Shape& shape, const ColorSlot& radiance) : shape_(shape) {
  const TriangleMesh& mesh = *shape.mesh;
  const uint32_t triangles = uint32_t(mesh.triangles.size());
  if (!radiance.is_constant()) choose_resolution(radiance);
  const uint32_t per_triangle = uint32_t(n_) * uint32_t(n_);
  std::vector<float> weights(size_t(triangles) * per_triangle);
  double area = 0;
  for (uint32_t t = 0; t < triangles; ++t) {
    const double cell_area = double(triangle_area(mesh, t)) / per_triangle;
    area += cell_area * per_triangle;
    for (uint32_t c = 0; c < per_triangle; ++c) {
      double sum = 0;
      if (radiance.is_constant()) {
        sum = double(radiance.constant.luminance()) * points_;
      } else {
        for (int k = 0; k < points_; ++k) {
          const Point2f b = within(cell(c), square_to_triangle(even_point(k)));
          const Surface s = textured_point(shape, point_on_triangle(shape, t, b));
          sum += double(std::max(radiance(s).luminance(), 0.0f));
        }
      }
      const double weight = cell_area * sum / points_;
      weights[size_t(t) * per_triangle + c] = float(weight);
      integral_ += weight;
    }
  }
  const double even = kEvenCellShare / (1 - kEvenCellShare) * integral_ / area;
  for (uint32_t t = 0; t < triangles; ++t) {
    const float cell_area = triangle_area(mesh, t) / float(per_triangle);
    for (uint32_t c = 0; c < per_triangle; ++c) {
      float& w = weights[size_t(t) * per_triangle + c];
      w = radiance.is_constant() ? cell_area : w + float(even) * cell_area;
    }
  }
  cells_ = DiscreteDistribution(weights);
  uniform_ = {radiance.is_constant() ? float(1 / area) : 0.0f};
}

void TriangleCells::choose_resolution(const ColorSlot& radiance) {
  const TriangleMesh& mesh = *shape_.mesh;
  const Point2i r = radiance.texture->resolution();
  double texels = 1;  // under the largest triangle
  for (const auto& t : mesh.triangles) {
    if (mesh.uvs.empty()) break;
    const Point2f a = mesh.uvs[t[1]] - mesh.uvs[t[0]], b = mesh.uvs[t[2]] - mesh.uvs[t[0]];
    texels = std::max(texels, 0.5 * std::abs(double(a.x) * b.y - double(a.y) * b.x) * r.x * r.y);
  }
  const double limit = kMaxCells / double(std::max<size_t>(mesh.triangles.size(), 1));
  n_ = std::max(1, int(std::sqrt(std::min(kCellsPerTexel * texels, limit))));
  points_ = std::clamp(int(2 * texels / (double(n_) * n_)), kMinPoints, kMaxPoints);
}

uint32_t TriangleCells::cell_at(const Point2f& b) const {
  const float x = b.x * float(n_), y = b.y * float(n_);
  const int i = std::clamp(int(x), 0, n_ - 1), j = std::clamp(int(y), 0, n_ - 1 - i);
  const bool upper = (x - float(i)) + (y - float(j)) > 1 && j < n_ - 1 - i;
  // Row i has 2 (n − i) − 1 cells.
  return uint32_t(i * (2 * n_ - i) + 2 * j + int(upper));
}

TriangleCells::Cell TriangleCells::cell(uint32_t number) const {
  // The rows from i on have (n − i)² cells.
  const int left = n_ * n_ - int(number);
  int rows = int(std::sqrt(float(left)));
  while (rows * rows < left) ++rows;
  const int i = n_ - rows, rest = int(number) - i * (2 * n_ - i);
  return {i, rest / 2, (rest & 1) != 0};
}

Point2f TriangleCells::within(const Cell& c, const Point2f& b) const {
  const float x = c.upper ? 1 - b.x : b.x, y = c.upper ? 1 - b.y : b.y;
  return Point2f{float(c.i) + x, float(c.j) + y} * (1 / float(n_));
}

ShapePoint TriangleCells::sample(const Point2f& u) const {
  const auto pick = cells_.sample(u.y, u);
  const uint32_t per_triangle = uint32_t(n_) * uint32_t(n_);
  const uint32_t triangle = n_ == 1 ? pick.index : pick.index / per_triangle;
  Point2f b = square_to_triangle({u.x, pick.remapped});
  if (n_ > 1) b = within(cell(pick.index % per_triangle), b);
  ShapePoint p = point_on_triangle(shape_, triangle, b);
  p.pdf =
      uniform_.value > 0 ? uniform_ : PdfA{pick.probability * float(per_triangle) * p.pdf.value};
  return p;
}

ShapePoint TriangleCells::sample(uint32_t triangle, const Point2f& u) const {
  if (n_ == 1) return point_on_triangle(shape_, triangle, square_to_triangle(u));
  const uint32_t count = uint32_t(n_) * uint32_t(n_);
  const auto pick = cells_.sample_within(triangle * count, count, u.y, u);
  const Point2f b = square_to_triangle({u.x, pick.remapped});
  ShapePoint p = point_on_triangle(shape_, triangle, within(cell(pick.index % count), b));
  p.pdf.value *= pick.probability * float(count);
  return p;
}

PdfA TriangleCells::pdf_within(uint32_t triangle, const Point2f& barycentric) const {
  const float even = 1 / triangle_area(*shape_.mesh, triangle);
  if (n_ == 1) return {even};
  const uint32_t count = uint32_t(n_) * uint32_t(n_);
  const float cell = cells_.probability(triangle * count + cell_at(barycentric));
  return {even * float(count) * cell / probability(triangle)};
}

PdfA TriangleCells::pdf(uint32_t primitive, const Point2f& barycentric) const {
  if (uniform_.value > 0) return uniform_;
  const uint32_t per_triangle = uint32_t(n_) * uint32_t(n_);
  const float p = cells_.probability(primitive * per_triangle + cell_at(barycentric));
  return {p * float(per_triangle) / triangle_area(*shape_.mesh, primitive)};
}

}  // namespace duet
