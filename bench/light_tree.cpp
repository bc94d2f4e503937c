// Builds the light of a mesh of many triangles, and chooses among them.
//
//   light_tree [MILLIONS]
//
// Prints the CPU seconds of the build with and without a tree, its bytes per triangle, the time of
// a choice and of asking for a probability, and how many triangles cannot be reached from a point
// above.
#include <fmt/format.h>

#include <cstdlib>

#include "cpu_time.h"
#include "lights/area.h"
#include "math/hash.h"

using namespace duet;

namespace {

/// A rough field of n x n squares, each of two triangles.
Shape field(uint32_t n) {
  auto mesh = std::make_shared<TriangleMesh>();
  for (uint32_t y = 0; y <= n; ++y)
    for (uint32_t x = 0; x <= n; ++x) {
      const float height = to_unit_float(uint32_t(mix64(uint64_t(y) << 32 | x) >> 32));
      mesh->positions.push_back({float(x), float(y), height});
    }
  for (uint32_t y = 0; y < n; ++y)
    for (uint32_t x = 0; x < n; ++x) {
      const uint32_t a = y * (n + 1) + x;
      mesh->triangles.push_back({a, a + 1, a + n + 2});
      mesh->triangles.push_back({a, a + n + 2, a + n + 1});
    }
  Shape shape;
  shape.mesh = std::move(mesh);
  return shape;
}

}  // namespace

int main(int argc, char** argv) {
  const double millions = argc > 1 ? std::atof(argv[1]) : 10;
  const uint32_t n = uint32_t(std::sqrt(millions * 5e5));
  const Shape shape = field(n);
  const ColorSlot radiance{Spectrum(1.0f)};
  for (const LightSelection selection : {LightSelection::power, LightSelection::automatic}) {
    const double start = cpu_seconds();
    const AreaLight light(shape, radiance, EmittingSide::shading, selection);
    fmt::print("{}: {} triangles in {:.2f} s\n", kLightSelectionNames[size_t(selection)],
               shape.mesh->triangles.size(), cpu_seconds() - start);
    const Point3f from(0.3f * float(n), 0.6f * float(n), 3);
    constexpr uint32_t choices = 1000000;
    double sum = 0;
    const double chosen = cpu_seconds();
    for (uint32_t i = 0; i < choices; ++i) {
      const uint64_t h = mix64(i);
      const auto s =
          light.sample_direct(from, {to_unit_float(uint32_t(h >> 32)), to_unit_float(uint32_t(h))});
      if (s) sum += double(s->weight.g);
    }
    fmt::print("  {:.0f} ns for a choice, mean {:.4f}\n", (cpu_seconds() - chosen) * 1e9 / choices,
               sum / choices);
    uint32_t unreachable = 0;
    for (uint32_t t = 0; t < shape.mesh->triangles.size(); ++t) {
      Surface s{};
      s.primitive = t;
      s.barycentric = {0.3f, 0.3f};
      const ShapePoint p = point_on_triangle(shape, t, s.barycentric);
      s.ng = p.ng;
      const Vector3f way = p.position - from;
      if (!(dot(p.ng, way) < 0)) continue;
      unreachable += !(light.pdf_direct(from, s, normalize(way), length_squared(way)).value > 0);
    }
    fmt::print("  {} triangles that face the point cannot be chosen\n", unreachable);
  }
}
