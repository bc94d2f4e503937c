// The geometry of pbrt's shapes: how it is made of their parameters.
#pragma once

#include <array>
#include <functional>
#include <span>

#include "geometry/curves.h"
#include "geometry/mesh.h"
#include "pbrt/parameter.h"
#include "scene/description.h"

namespace duet::pbrt {

/// What all shapes have.
inline constexpr Spec kShapeSpecs[] = {
    {"alpha", kNumberTexture, "1", "probability that light meets the surface"},
    {"shadowalpha", kNumberTexture, "", "", 1, Status::ignored, Versions::v3},
};

/// A point of a surface with its normal, of any length.
struct GridPoint {
  Point3f position;
  Normal3f normal;
};
/// Patches between points of a surface given by two parameters from 0 to 1, which become the
/// texture coordinates.
TriangleMesh make_grid(int columns, int rows, const std::function<GridPoint(double, double)>& at);

// In pbrt's object space, with its texture coordinates and normals; angles in degrees.
TriangleMesh make_sphere(double radius, double z_min, double z_max, double phi_max);
TriangleMesh make_cylinder(double radius, double z_min, double z_max, double phi_max);
TriangleMesh make_disk(double radius, double inner_radius, double height, double phi_max);
/// Its base is at z = 0.
TriangleMesh make_cone(double radius, double height, double phi_max);
/// `radius` is that at z_max.
TriangleMesh make_paraboloid(double radius, double z_min, double z_max, double phi_max);
/// The line between two points, turned about the z axis.
TriangleMesh make_hyperboloid(const std::array<double, 3>& p1, const std::array<double, 3>& p2,
                              double phi_max);

/// A mesh of bilinear patches: corners p00, p10, p01, p11. Patches that are parallelograms become
/// two triangles, others a grid of them. `normals` and `uvs` are empty or one per position.
struct PatchMesh {
  std::vector<Point3f> positions;
  std::vector<Normal3f> normals;
  std::vector<Point2f> uvs;
  std::vector<std::array<uint32_t, 4>> patches;
};
/// Appends the patches to a mesh that has normals and texture coordinates, or neither as `with…`
/// says.
void append_patches(const PatchMesh& patches, TriangleMesh& mesh);

/// Loop's subdivision with `levels` steps, then the limit positions and normals. Source: Loop,
/// "Smooth Subdivision Surfaces Based on Triangles", 1987.
TriangleMesh subdivide_loop(const std::vector<Point3f>& positions,
                            const std::vector<std::array<uint32_t, 3>>& triangles, int levels);

/// What bumps take as tangents on triangles that files give.
BumpTangents bump_tangents(Version version);

/// Gives a mesh without texture coordinates those that pbrt has by default, if they are needed.
void finish_triangles(TriangleMesh& mesh, bool needs_uv);

/// By file what pbrt makes one shape, and so one light, of each triangle of.
bool is_light_per_triangle(const Plugin& shape);
/// Whether the triangles of a mesh differ in area. Then it has the attribute kShareOfTriangle, how
/// often the area of the first triangle is that of each.
bool set_shares_of_triangles(ShapeDescription& shape);
inline constexpr const char* kShareOfTriangle = "face_share_of_power";

}  // namespace duet::pbrt
