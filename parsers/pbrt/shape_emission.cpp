// What the light of a shape depends on besides AreaLightSource: its triangles, normals and alpha.
#include <cmath>

#include "pbrt/reader.h"
#include "pbrt/shapes.h"

namespace duet::pbrt {

namespace {

double triangle_area(const TriangleMesh& mesh, const Transform& place,
                     const std::array<uint32_t, 3>& t) {
  const Point3f p = place(mesh.positions[t[0]]);
  return 0.5 *
         double(length(cross(place(mesh.positions[t[1]]) - p, place(mesh.positions[t[2]]) - p)));
}

double area(const TriangleMesh& mesh, const Transform& place) {
  double sum = 0;
  for (const auto& t : mesh.triangles) sum += triangle_area(mesh, place, t);
  return sum;
}

/// The first that is one.
double first_area(const TriangleMesh& mesh, const Transform& place) {
  for (const auto& t : mesh.triangles)
    if (const double a = triangle_area(mesh, place, t); a > 0) return a;
  return 0;
}

/// Where the shape stands, or begins to move.
Transform place_of(const ShapeDescription& shape) {
  return Transform(shape.motion.empty() ? shape.to_world
                                        : shape.motion.keyframes().front().pose * shape.to_world);
}

}  // namespace

bool is_light_per_triangle(const Plugin& shape) {
  return shape.name == "trianglemesh" || shape.name == "plymesh" || shape.name == "loopsubdiv";
}

bool set_shares_of_triangles(ShapeDescription& shape) {
  auto& m = std::get<MeshShape>(shape.geometry);
  const Transform place = place_of(shape);
  const double first = first_area(*m.mesh, place);
  MeshAttribute shares{kShareOfTriangle, 1, true, {}};
  bool differ = false;
  for (const auto& t : m.mesh->triangles) {
    const double a = triangle_area(*m.mesh, place, t);
    shares.data.push_back(a > 0 ? float(first / a) : 0.0f);
    differ |= std::abs(shares.data.back() - 1) > 1e-4f;
  }
  if (!differ) return false;
  TriangleMesh mesh = *m.mesh;
  mesh.attributes.push_back(std::move(shares));
  m = MeshShape(std::make_shared<const TriangleMesh>(std::move(mesh)));
  return true;
}

double Reader::area_of_light(const Plugin& from, const ShapeDescription& shape,
                             const ShapeParts& parts) {
  if (const auto* m = std::get_if<MeshShape>(&shape.geometry)) {
    if (is_light_per_triangle(from)) return first_area(*m->mesh, place_of(shape));
    // Patches are in the world already when pbrt asks for their area.
    return area(*m->mesh, from.name == "bilinearmesh" ? place_of(shape) : Transform());
  }
  if (std::holds_alternative<CurvesShape>(shape.geometry)) {
    report_.error(from.where, "curves cannot have a light with \"power\"");
    return 1;
  }
  const TriangleMesh made =
      std::holds_alternative<SphereShape>(shape.geometry)     ? make_sphere(1, -1, 1, 360)
      : std::holds_alternative<CylinderShape>(shape.geometry) ? make_cylinder(1, 0, 1, 360)
                                                              : make_disk(1, 0, 0, 360);
  return area(made, Transform(parts.to_object));
}

void Reader::finish_emission(const Plugin& from, ShapeDescription& shape, bool has_normals) {
  AreaEmission& emission = *shape.emission;
  const bool is_mesh = std::holds_alternative<MeshShape>(shape.geometry);
  if (is_mesh && has_normals && emission.side == EmittingSide::shading)
    emission.side = EmittingSide::geometric;
  const auto multiply = [&](const ColorInput& factor) {
    emission.radiance = add_texture(ProductDescription{factor, emission.radiance}, from.where);
  };
  const Parameter* power = state_.area_light->find("power");
  if (power && !power->numbers.empty() && power->numbers[0] > 0 && is_light_per_triangle(from) &&
      set_shares_of_triangles(shape))
    multiply(add_texture(MeshAttributeTexture{kShareOfTriangle}, from.where));
  const std::optional<FloatInput> alpha = alpha_of(from);
  if (!alpha) return;
  const double* constant = std::get_if<double>(&*alpha);
  // In v3 only rays see alpha. In v4 a surface that is not there does not shine, but alpha 0 is the
  // way to make a light invisible.
  if (version_ == Version::v3)
    approximate(from.where, "a light with alpha shines where alpha takes the surface away, too");
  else if (!constant)
    multiply(std::get<TextureId>(*alpha));
  else if (*constant > 0)
    multiply(Spectrum(float(*constant)));
}

}  // namespace duet::pbrt
