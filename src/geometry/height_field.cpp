#include "geometry/height_field.h"

#include <algorithm>
#include <cmath>

namespace duet {

namespace {

class HeightFieldMesh {
 public:
  explicit HeightFieldMesh(const HeightField& field)
      : f_(field), cells_x_(field.columns - 1), cells_y_(field.rows - 1), n_(subdivision()) {}

  TriangleMesh make() {
    if (f_.shading_normals)
      make_smooth();
    else
      make_patches();
    return std::move(mesh_);
  }

 private:
  float height(int x, int y) const {
    return f_.heights[size_t(y) * size_t(f_.columns) + size_t(x)];
  }

  /// A bilinear patch: its heights and where in the grid it lies.
  struct Patch {
    int x, y;
    double f00, f10, f01, f11;

    double height(double u, double v) const {
      return (1 - v) * ((1 - u) * f00 + u * f10) + v * ((1 - u) * f01 + u * f11);
    }
    /// Across the patch, in the space of the grid.
    Vector3f normal(double u, double v) const {
      return {float((1 - v) * (f00 - f10) + v * (f01 - f11)),
              float((1 - u) * (f00 - f01) + u * (f10 - f11)), 1};
    }
    double twist() const { return std::abs(f00 - f10 - f01 + f11); }
  };
  Patch patch(int x, int y) const {
    return {x,
            y,
            double(height(x, y)),
            double(height(x + 1, y)),
            double(height(x, y + 1)),
            double(height(x + 1, y + 1))};
  }

  int subdivision() const {
    constexpr double kTolerance = 1.0 / 512, kMostTriangles = 1 << 20;
    const auto [low, high] = std::minmax_element(f_.heights.begin(), f_.heights.end());
    const double tolerance = kTolerance * (double(*high) - double(*low));
    double twist = 0;
    for (int y = 0; y < cells_y_; ++y)
      for (int x = 0; x < cells_x_; ++x) twist = std::max(twist, patch(x, y).twist());
    int n = 1;
    while (twist > 4.0 * n * n * tolerance &&
           2.0 * cells_x_ * cells_y_ * (2.0 * n) * (2.0 * n) <= kMostTriangles)
      n *= 2;
    return n;
  }

  /// The point (u, v) of a patch; `normal` is in the space of the grid.
  uint32_t add_vertex(const Patch& p, double u, double v, const Vector3f& normal) {
    const double s = (p.x + u) / cells_x_, t = (p.y + v) / cells_y_;
    mesh_.positions.push_back({float(2 * s - 1), float(2 * t - 1), float(p.height(u, v))});
    mesh_.uvs.push_back({float(s), float(t)});
    mesh_.normals.push_back(normalized_or_zero(
        {normal.x * 0.5f * float(cells_x_), normal.y * 0.5f * float(cells_y_), normal.z}));
    return uint32_t(mesh_.positions.size() - 1);
  }

  /// Squares between vertices in rows of `width`, the first of which is `first`.
  void add_squares(uint32_t first, uint32_t width, uint32_t columns, uint32_t rows) {
    for (uint32_t y = 0; y < rows; ++y)
      for (uint32_t x = 0; x < columns; ++x) {
        const uint32_t a = first + y * width + x, c = a + width;
        mesh_.triangles.push_back({a, a + 1, c + 1});
        mesh_.triangles.push_back({a, c + 1, c});
      }
  }

  /// Not of length one: only directions count.
  std::vector<Vector3f> corner_normals() const {
    std::vector<Vector3f> normals(f_.heights.size(), Vector3f(0, 0, 0));
    for (int y = 0; y < cells_y_; ++y)
      for (int x = 0; x < cells_x_; ++x) {
        const Patch p = patch(x, y);
        for (int corner = 0; corner < 4; ++corner) {
          const int u = corner % 2, v = corner / 2;
          normals[size_t(y + v) * size_t(f_.columns) + size_t(x + u)] += normalize(p.normal(u, v));
        }
      }
    for (Vector3f& n : normals) n = normalize(n);
    return normals;
  }

  void make_smooth() {
    const std::vector<Vector3f> normals = corner_normals();
    const int columns = cells_x_ * n_, rows = cells_y_ * n_;
    reserve(size_t(columns + 1) * size_t(rows + 1));
    for (int j = 0; j <= rows; ++j)
      for (int i = 0; i <= columns; ++i) {
        const int x = std::min(i / n_, cells_x_ - 1), y = std::min(j / n_, cells_y_ - 1);
        const double u = i / double(n_) - x, v = j / double(n_) - y;
        const Vector3f* n = &normals[size_t(y) * size_t(f_.columns) + size_t(x)];
        const Vector3f below = n[0] * float(1 - u) + n[1] * float(u);
        n += f_.columns;
        const Vector3f above = n[0] * float(1 - u) + n[1] * float(u);
        add_vertex(patch(x, y), u, v, below * float(1 - v) + above * float(v));
      }
    add_squares(0, uint32_t(columns + 1), uint32_t(columns), uint32_t(rows));
  }

  void make_patches() {
    const uint32_t width = uint32_t(n_ + 1);
    reserve(size_t(cells_x_) * size_t(cells_y_) * width * width);
    for (int y = 0; y < cells_y_; ++y)
      for (int x = 0; x < cells_x_; ++x) {
        const Patch p = patch(x, y);
        const uint32_t first = uint32_t(mesh_.positions.size());
        for (int j = 0; j <= n_; ++j)
          for (int i = 0; i <= n_; ++i) {
            const double u = i / double(n_), v = j / double(n_);
            add_vertex(p, u, v, p.normal(u, v));
          }
        add_squares(first, width, uint32_t(n_), uint32_t(n_));
      }
  }

  void reserve(size_t vertices) {
    // Embree may read beyond the last vertex: one more saves a copy.
    mesh_.positions.reserve(vertices + 1);
    mesh_.uvs.reserve(vertices);
    mesh_.normals.reserve(vertices);
    mesh_.triangles.reserve(2 * size_t(cells_x_) * size_t(cells_y_) * size_t(n_) * size_t(n_));
  }

  const HeightField& f_;
  const int cells_x_, cells_y_;
  const int n_;  ///< squares along each side of a patch
  TriangleMesh mesh_;
};

}  // namespace

TriangleMesh make_height_field(const HeightField& field) {
  return HeightFieldMesh(field).make();
}

}  // namespace duet
