// Surfaces given by formulas, as meshes.
#include <algorithm>
#include <cmath>

#include "math/angles.h"
#include "pbrt/shapes.h"

namespace duet::pbrt {

namespace {

/// Around the axis: the corners lie within 10⁻⁴ of the radius.
constexpr int kAround = 256;

int columns_for(double phi_max) {
  return std::max(2, int(std::ceil(kAround * phi_max / 360)));
}

bool finite(const GridPoint& p) {
  return is_finite(p.position) && is_finite(Vector3f(p.normal));
}

}  // namespace

TriangleMesh make_grid(int columns, int rows, const std::function<GridPoint(double, double)>& at) {
  TriangleMesh mesh;
  const uint32_t stride = uint32_t(columns) + 1;
  for (int j = 0; j <= rows; ++j)
    for (int i = 0; i <= columns; ++i) {
      const double u = double(i) / columns, v = double(j) / rows;
      const GridPoint p = at(u, v);
      mesh.positions.push_back(finite(p) ? p.position : Point3f(0));
      mesh.normals.push_back(normalized_or_zero(p.normal));
      mesh.uvs.push_back({float(u), float(v)});
    }
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i) {
      const uint32_t a = uint32_t(j) * stride + uint32_t(i);
      const std::array<std::array<uint32_t, 3>, 2> halves{
          {{a, a + 1, a + stride + 1}, {a, a + stride + 1, a + stride}}};
      for (const auto& t : halves) {
        const Point3f p = mesh.positions[t[0]];
        // At a pole one half of a patch is nothing.
        if (length_squared(cross(mesh.positions[t[1]] - p, mesh.positions[t[2]] - p)) > 0)
          mesh.triangles.push_back(t);
      }
    }
  return mesh;
}

TriangleMesh make_sphere(double radius, double z_min, double z_max, double phi_max) {
  const double r = radius;
  const double first = std::acos(std::clamp(z_min / r, -1.0, 1.0)),
               last = std::acos(std::clamp(z_max / r, -1.0, 1.0));
  const int rows = std::max(2, int(std::ceil(std::abs(first - last) / 3.14159265 * kAround / 2)));
  return make_grid(columns_for(phi_max), rows, [&](double u, double v) {
    const double phi = u * phi_max * kRadians, theta = first + v * (last - first);
    const Normal3f n(float(std::sin(theta) * std::cos(phi)), float(std::sin(theta) * std::sin(phi)),
                     float(std::cos(theta)));
    return GridPoint{Point3f(0) + Vector3f(n) * float(r), n};
  });
}

TriangleMesh make_cylinder(double radius, double z_min, double z_max, double phi_max) {
  return make_grid(columns_for(phi_max), 1, [&](double u, double v) {
    const double phi = u * phi_max * kRadians;
    const Normal3f n(float(std::cos(phi)), float(std::sin(phi)), 0);
    return GridPoint{{float(radius) * n.x, float(radius) * n.y, float(z_min + v * (z_max - z_min))},
                     n};
  });
}

TriangleMesh make_disk(double radius, double inner_radius, double height, double phi_max) {
  // Texture coordinates are not linear on triangles of a polar grid; many rings make up for that.
  constexpr int kRings = 32;
  return make_grid(columns_for(phi_max), kRings, [&](double u, double v) {
    const double phi = u * phi_max * kRadians, r = radius + v * (inner_radius - radius);
    return GridPoint{{float(r * std::cos(phi)), float(r * std::sin(phi)), float(height)},
                     Normal3f(0, 0, 1)};
  });
}

// On a cone's triangles texture coordinates are not linear either.
TriangleMesh make_cone(double radius, double height, double phi_max) {
  constexpr int kRows = 32;
  return make_grid(columns_for(phi_max), kRows, [&](double u, double v) {
    const double phi = u * phi_max * kRadians, r = radius * (1 - v);
    const double c = std::cos(phi), s = std::sin(phi);
    return GridPoint{{float(r * c), float(r * s), float(v * height)},
                     Normal3f(float(height * c), float(height * s), float(radius))};
  });
}

TriangleMesh make_paraboloid(double radius, double z_min, double z_max, double phi_max) {
  constexpr int kRows = 128;
  const double inner = std::sqrt(z_min / z_max);
  // Rows at equal steps of the radius: at equal heights the tip would be blunt.
  const auto height = [&](double share) {
    const double r = inner + share * (1 - inner);
    return z_max * r * r;
  };
  TriangleMesh mesh = make_grid(columns_for(phi_max), kRows, [&](double u, double v) {
    const double phi = u * phi_max * kRadians, z = height(v), r = radius * std::sqrt(z / z_max);
    const double c = std::cos(phi), s = std::sin(phi), out = 2 * std::sqrt(z * z_max);
    return GridPoint{{float(r * c), float(r * s), float(z)},
                     Normal3f(float(out * c), float(out * s), float(-radius))};
  });
  for (Point2f& g : mesh.uvs) g.y = float((height(double(g.y)) - z_min) / (z_max - z_min));
  return mesh;
}

TriangleMesh make_hyperboloid(const std::array<double, 3>& p1, const std::array<double, 3>& p2,
                              double phi_max) {
  constexpr int kRows = 128;
  return make_grid(columns_for(phi_max), kRows, [&](double u, double v) {
    const double phi = u * phi_max * kRadians, c = std::cos(phi), s = std::sin(phi);
    const auto turned = [&](double x, double y, double z) {
      return Vector3f(float(x * c - y * s), float(x * s + y * c), float(z));
    };
    std::array<double, 3> p, along;
    for (size_t i = 0; i < 3; ++i) along[i] = p2[i] - p1[i], p[i] = p1[i] + v * along[i];
    const Vector3f place = turned(p[0], p[1], p[2]), dv = turned(along[0], along[1], along[2]);
    // On the axis the normal is that of the neighbours.
    const Vector3f near = place + dv * (v < 0.5 ? 1e-3f : -1e-3f);
    const Vector3f from = place.x == 0 && place.y == 0 ? near : place;
    return GridPoint{Point3f(0) + place, Normal3f(cross(Vector3f(-from.y, from.x, 0), dv))};
  });
}

namespace {

struct Patch {
  std::array<Point3f, 4> p;
  bool is_parallelogram() const {
    const Vector3f off = (p[3] - p[2]) - (p[1] - p[0]);
    return max_abs(off) <= 1e-5f * std::max(max_abs(p[1] - p[0]), max_abs(p[2] - p[0]));
  }
  Vector3f du(float v) const { return lerp_(p[1] - p[0], p[3] - p[2], v); }
  Vector3f dv(float u) const { return lerp_(p[2] - p[0], p[3] - p[1], u); }

 private:
  static Vector3f lerp_(const Vector3f& a, const Vector3f& b, float t) {
    return a * (1 - t) + b * t;
  }
};

template <class T>
T bilinear(const std::array<T, 4>& c, float u, float v) {
  return c[0] * ((1 - u) * (1 - v)) + c[1] * (u * (1 - v)) + c[2] * ((1 - u) * v) + c[3] * (u * v);
}

/// How finely a patch that is not flat is divided: all patches of a mesh together are not many more
/// triangles than this.
int divisions(size_t patches) {
  constexpr double kTriangles = 2e6;
  return std::clamp(int(std::sqrt(kTriangles / 2 / double(std::max<size_t>(patches, 1)))), 4, 32);
}

}  // namespace

void append_patches(const PatchMesh& source, TriangleMesh& mesh) {
  const int fine = divisions(source.patches.size());
  for (const auto& corner : source.patches) {
    Patch patch;
    for (size_t i = 0; i < 4; ++i) patch.p[i] = source.positions[corner[i]];
    const int n = patch.is_parallelogram() ? 1 : fine;
    const uint32_t first = uint32_t(mesh.positions.size());
    std::array<Vector3f, 4> normals;
    std::array<Point2f, 4> uvs{{{0, 0}, {1, 0}, {0, 1}, {1, 1}}};
    for (size_t i = 0; i < 4; ++i) {
      if (!source.normals.empty()) normals[i] = Vector3f(source.normals[corner[i]]);
      if (!source.uvs.empty()) uvs[i] = source.uvs[corner[i]];
    }
    const TriangleMesh grid = make_grid(n, n, [&](double u, double v) {
      const float s = float(u), t = float(v);
      const Vector3f p = bilinear<Vector3f>({patch.p[0] - Point3f(0), patch.p[1] - Point3f(0),
                                             patch.p[2] - Point3f(0), patch.p[3] - Point3f(0)},
                                            s, t);
      const Vector3f normal =
          source.normals.empty() ? cross(patch.du(t), patch.dv(s)) : bilinear(normals, s, t);
      return GridPoint{Point3f(0) + p, Normal3f(normal)};
    });
    mesh.positions.insert(mesh.positions.end(), grid.positions.begin(), grid.positions.end());
    mesh.normals.insert(mesh.normals.end(), grid.normals.begin(), grid.normals.end());
    for (const Point2f& g : grid.uvs) {
      const float a = (1 - g.x) * (1 - g.y), b = g.x * (1 - g.y), c = (1 - g.x) * g.y,
                  d = g.x * g.y;
      mesh.uvs.push_back({uvs[0].x * a + uvs[1].x * b + uvs[2].x * c + uvs[3].x * d,
                          uvs[0].y * a + uvs[1].y * b + uvs[2].y * c + uvs[3].y * d});
    }
    for (const auto& [a, b, c] : grid.triangles)
      mesh.triangles.push_back({first + a, first + b, first + c});
  }
}

}  // namespace duet::pbrt
