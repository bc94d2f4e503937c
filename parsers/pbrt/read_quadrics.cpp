// Shapes that turn about the z axis.
#include <algorithm>
#include <limits>

#include "pbrt/shape_readers.h"

namespace duet::pbrt {

namespace {

using enum Status;

double phi_max(Values& v) {
  return std::clamp(v.number("phimax"), 0.0, 360.0);
}

constexpr Spec kSphere[] = {
    {"radius", kNumber, "1"},
    {"zmin", kNumber, "", "where it is cut; default: not at all"},
    {"zmax", kNumber},
    {"phimax", kNumber, "360", "degrees"},
};

void read_sphere(Values& v) {
  const double r = v.positive("radius");
  const auto z = [&](const char* name, double preset) {
    return std::clamp(v.has(name) ? v.number(name) : preset, -r, r);
  };
  double z_min = z("zmin", -r), z_max = z("zmax", r);
  if (z_min > z_max) std::swap(z_min, z_max);
  const double phi = phi_max(v);
  if (z_min == -r && z_max == r && phi == 360) {
    // Its texture coordinates begin at the lower pole.
    v.reader().add_shape(
        v.plugin(),
        {.geometry = SphereShape{}, .to_object = Matrix4::scale(r, r, -r), .mirrors = true});
    return;
  }
  add_mesh(v, make_sphere(r, z_min, z_max, phi), false);
}

constexpr Spec kCylinder[] = {
    {"radius", kNumber, "1"},
    {"zmin", kNumber, "-1"},
    {"zmax", kNumber, "1"},
    {"phimax", kNumber, "360", "degrees"},
};

void read_cylinder(Values& v) {
  const double r = v.positive("radius"), a = v.number("zmin"), b = v.number("zmax"),
               phi = phi_max(v);
  const double z_min = std::min(a, b), z_max = std::max(a, b);
  if (phi == 360 && z_max > z_min)
    v.reader().add_shape(v.plugin(), {.geometry = CylinderShape{},
                                      .to_object = Matrix4::translate(0, 0, z_min) *
                                                   Matrix4::scale(r, r, z_max - z_min)});
  else
    add_mesh(v, make_cylinder(r, z_min, z_max, phi), false);
}

constexpr Spec kDisk[] = {
    {"radius", kNumber, "1"},
    {"innerradius", kNumber, "0"},
    {"height", kNumber, "0"},
    {"phimax", kNumber, "360", "degrees"},
};

void read_disk(Values& v) {
  const double r = v.positive("radius"), inner = v.not_negative("innerradius"),
               height = v.number("height"), phi = phi_max(v);
  if (inner == 0 && phi == 360 && !v.reader().needs_uv(v.plugin()))
    v.reader().add_shape(v.plugin(),
                         {.geometry = DiskShape{},
                          .to_object = Matrix4::translate(0, 0, height) * Matrix4::scale(r, r, 1)});
  else
    add_mesh(v, make_disk(r, inner, height, phi), false);
}

constexpr Spec kCone[] = {
    {"radius", kNumber, "1"}, {"height", kNumber, "1"}, {"phimax", kNumber, "360", "degrees"}};

void read_cone(Values& v) {
  add_mesh(v, make_cone(v.positive("radius"), v.number("height"), phi_max(v)), false);
}

constexpr Spec kParaboloid[] = {{"radius", kNumber, "1", "at zmax"},
                                {"zmin", kNumber, "0"},
                                {"zmax", kNumber, "1"},
                                {"phimax", kNumber, "360", "degrees"}};

void read_paraboloid(Values& v) {
  const double a = v.number("zmin"), b = v.number("zmax"), low = std::min(a, b),
               high = std::max(a, b);
  if (!(low >= 0 && high > low)) {
    v.reader().report().error(v.where("zmin"), "a paraboloid lies between heights above zero");
    return;
  }
  add_mesh(v, make_paraboloid(v.positive("radius"), low, high, phi_max(v)), false);
}

constexpr Spec kHyperboloid[] = {{"p1", kPoint3, "0 0 0", "of a line that turns about z"},
                                 {"p2", kPoint3, "1 1 1"},
                                 {"phimax", kNumber, "360", "degrees"}};

void read_hyperboloid(Values& v) {
  add_mesh(v, make_hyperboloid(v.point("p1"), v.point("p2"), phi_max(v)), false);
}

constexpr std::string_view kAsTriangles = "becomes triangles";
constexpr Record<ReadShape> kQuadrics[] = {
    {"sphere", Versions::both, done, "parts of one become triangles", kSphere, read_sphere},
    {"cylinder", Versions::both, done, "parts of one become triangles", kCylinder, read_cylinder},
    {"disk", Versions::both, done, "rings and parts become triangles", kDisk, read_disk},
    {"cone", Versions::v3, done, kAsTriangles, kCone, read_cone},
    {"paraboloid", Versions::v3, done, kAsTriangles, kParaboloid, read_paraboloid},
    {"hyperboloid", Versions::v3, done, kAsTriangles, kHyperboloid, read_hyperboloid},
};

}  // namespace

std::span<const Record<ReadShape>> quadric_shapes() {
  return kQuadrics;
}

}  // namespace duet::pbrt
