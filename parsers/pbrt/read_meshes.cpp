// Shapes that are meshes, or become some by rules of their own.
#include <cmath>

#include "mesh/mesh_file.h"
#include "pbrt/mesh_arrays.h"
#include "pbrt/nurbs.h"
#include "pbrt/shape_readers.h"

namespace duet::pbrt {

namespace {

using enum Status;

constexpr Spec kTriangleMesh[] = {
    {"indices", kInteger, "", "three per triangle; optional for three points", 0},
    {"P", kPoint3, "", "positions", 0},
    {"N", kNormal, "", "normals", 0},
    {"S", kVector3, "", "tangents", 0, ignored},
    {"uv", kPoint2, "", "texture coordinates", 0},
    {"st", kPoint2, "", "the same", 0, done, Versions::v3},
    {"faceIndices", kInteger, "", "", 0, inert},
};

void read_triangle_mesh(Values& v) {
  TriangleMesh mesh;
  if (!read_arrays(v, v.has("st") && !v.has("uv") ? "st" : "uv", mesh, mesh.triangles)) return;
  finish_triangles(mesh, v.reader().needs_uv(v.plugin()));
  const bool own_normals = !mesh.normals.empty();
  if (own_normals) mesh.bump_tangents = bump_tangents(v.reader().version());
  add_mesh(v, std::move(mesh), own_normals);
}

constexpr Spec kBilinearMesh[] = {
    {"indices", kInteger, "", "four per patch; optional for four points", 0},
    {"P", kPoint3, "", "positions", 0},
    {"N", kNormal, "", "normals", 0},
    {"uv", kPoint2, "", "texture coordinates", 0},
    {"faceIndices", kInteger, "", "", 0, inert},
    {"emissionfilename", kString, "", "", 1, inert},
};

void read_bilinear_mesh(Values& v) {
  PatchMesh mesh;
  if (!read_arrays(v, "uv", mesh, mesh.patches)) return;
  TriangleMesh triangles;
  append_patches(mesh, triangles);
  add_mesh(v, std::move(triangles), true);
}

constexpr Spec kPlyMesh[] = {
    {"filename", kString, "", "a .ply or .ply.gz file"},
    {"displacement", kTexture, "", "moves the surface along its normals, once", 1, done,
     Versions::v4},
    {"edgelength", kNumber, "1", "all edges are shorter than this, in the world", 1, done,
     Versions::v4},
    {"displacement.edgelength", kNumber, "1", "the same by another name", 1, done, Versions::v4},
};

/// What a displaced mesh cannot be.
bool can_be_displaced(Values& v, const TriangleMesh& mesh) {
  Reader& reader = v.reader();
  const SourceLocation& where = v.where("displacement");
  if (mesh.uvs.empty()) {
    reader.report().error(where, "the file has no texture coordinates, which displacement needs");
    return false;
  }
  const auto light = reader.state().area_light;
  if (!light || reader.in_object()) return true;
  if (light->find("power"))
    reader.report().error(where,
                          "a light with \"power\" cannot be displaced: its area is not known yet");
  if (!reader.motion(v.plugin()).empty())
    reader.report().error(where, "a light that moves cannot be displaced");
  return true;
}

void read_ply_mesh(Values& v) {
  if (!v.has("filename")) {
    v.reader().report().error(v.where(), "\"string filename\" is needed");
    return;
  }
  const std::string path = v.file("filename");
  if (path.empty()) return;
  const bool displaced = v.has("displacement");
  const PlyUse use = displaced                         ? PlyUse::displaced
                     : v.reader().needs_uv(v.plugin()) ? PlyUse::with_uv
                                                       : PlyUse::plain;
  const auto mesh = v.reader().ply_mesh(path, use, v.where("filename"));
  if (!mesh || (displaced && !can_be_displaced(v, *mesh->mesh))) return;
  const bool own_normals = mesh->own_normals;
  MeshSource source;
  source.pbrt_file = path;
  if (mesh->is_whole_file) {
    source.file = path;
    source.plugin = "ply";
    source.flip_tex_coords = false;
  }
  MeshShape shape{mesh->mesh, source};
  if (displaced) {
    shape.displacement = v.float_input("displacement");
    const char* length =
        v.has("displacement.edgelength") ? "displacement.edgelength" : "edgelength";
    shape.edge_length = v.positive(length) * v.reader().displacement_edge_scale;
  }
  v.reader().add_shape(v.plugin(), {.geometry = std::move(shape), .has_normals = own_normals});
}

constexpr Spec kLoop[] = {
    {"levels", kInteger, "3", "steps of subdivision"},
    {"nlevels", kInteger, "3", "the same", 1, done, Versions::v3},
    {"indices", kInteger, "", "three per triangle", 0},
    {"P", kPoint3, "", "positions", 0},
    {"scheme", kString, "", "", 1, inert},
};

void read_loop_subdivision(Values& v) {
  const std::vector<Point3f> positions = points(v, "P");
  const auto triangles = indices<3>(v, positions.size());
  if (!triangles || positions.empty()) return;
  const int levels = v.reader().version() == Version::v3 && !v.has("levels") ? v.integer("nlevels")
                                                                             : v.integer("levels");
  constexpr double kMost = 5e7;
  if (levels < 0 || double(triangles->size()) * std::pow(4.0, levels) > kMost) {
    v.reader().report().error(v.where("levels"), "{} levels of subdivision are too many", levels);
    return;
  }
  TriangleMesh mesh = subdivide_loop(positions, *triangles, levels);
  mesh.bump_tangents = bump_tangents(v.reader().version());
  add_mesh(v, std::move(mesh), true);
}

constexpr Spec kHeightField[] = {
    {"nu", kInteger, "", "points along x"},
    {"nv", kInteger, "", "points along y"},
    {"Pz", kNumber, "", "heights over the unit square, x fastest", 0},
    {"z", kNumber, "", "the same", 0},
};

void read_height_field(Values& v) {
  const double columns = v.number("nu"), rows = v.number("nv");
  const std::vector<double> heights = v.numbers(v.has("Pz") ? "Pz" : "z");
  if (!(columns >= 2 && rows >= 2 && columns * rows == double(heights.size()))) {
    v.reader().report().error(
        v.where("nu"), "a height field needs nu x nv heights, at least 2 x 2: {} x {} have {}",
        columns, rows, heights.size());
    return;
  }
  const uint32_t nx = uint32_t(columns), ny = uint32_t(rows);
  TriangleMesh mesh;
  for (uint32_t y = 0; y < ny; ++y)
    for (uint32_t x = 0; x < nx; ++x) {
      const Point2f p{float(x) / float(nx - 1), float(y) / float(ny - 1)};
      mesh.positions.push_back({p.x, p.y, float(heights[size_t(y) * nx + x])});
      mesh.uvs.push_back(p);
    }
  for (uint32_t y = 0; y + 1 < ny; ++y)
    for (uint32_t x = 0; x + 1 < nx; ++x) {
      const uint32_t a = y * nx + x;
      mesh.triangles.push_back({a, a + 1, a + nx + 1});
      mesh.triangles.push_back({a, a + nx + 1, a + nx});
    }
  add_mesh(v, std::move(mesh), false);
}

constexpr Spec kNurbs[] = {
    {"nu", kInteger, "", "control points along u"},
    {"nv", kInteger, "", "control points along v"},
    {"uorder", kInteger, "", "one more than the degree"},
    {"vorder", kInteger},
    {"uknots", kNumber, "", "nu + uorder of them", 0},
    {"vknots", kNumber, "", "", 0},
    {"u0", kNumber, "", "where it begins; default: by the knots"},
    {"v0", kNumber},
    {"u1", kNumber},
    {"v1", kNumber},
    {"P", kPoint3, "", "control points, u fastest", 0},
    {"Pw", kNumber, "", "the same, times a weight, which is the fourth", 0},
};

void read_nurbs(Values& v) {
  NurbsSurface n;
  const auto axis = [&](SplineAxis& a, const char* count, const char* order, const char* knots,
                        const char* begin, const char* end) {
    a.count = v.integer(count), a.order = v.integer(order), a.knots = v.numbers(knots);
    if (!check_axis(a).empty()) return;
    a.begin = v.has(begin) ? v.number(begin) : a.knots[size_t(a.order) - 1];
    a.end = v.has(end) ? v.number(end) : a.knots[size_t(a.count)];
  };
  axis(n.u, "nu", "uorder", "uknots", "u0", "u1");
  axis(n.v, "nv", "vorder", "vknots", "v0", "v1");
  const std::vector<double> p = v.numbers("P"), pw = v.numbers("Pw");
  for (size_t i = 0; i + 2 < p.size(); i += 3) n.points.push_back({p[i], p[i + 1], p[i + 2], 1});
  if (p.empty())
    for (size_t i = 0; i + 3 < pw.size(); i += 4)
      n.points.push_back({pw[i], pw[i + 1], pw[i + 2], pw[i + 3]});
  if (const std::string why = check_nurbs(n); !why.empty()) {
    v.reader().report().error(v.where(), "{}", why);
    return;
  }
  TriangleMesh mesh = make_nurbs(n);
  mesh.bump_tangents = bump_tangents(v.reader().version());
  add_mesh(v, std::move(mesh), true);
}

constexpr Record<ReadShape> kMeshes[] = {
    {"trianglemesh", Versions::both, done, "", kTriangleMesh, read_triangle_mesh},
    {"plymesh", Versions::both, done,
     "faces of four corners are bilinear patches, in v3 two triangles", kPlyMesh, read_ply_mesh},
    {"bilinearmesh", Versions::v4, done, "patches that are not flat become triangles",
     kBilinearMesh, read_bilinear_mesh},
    {"loopsubdiv", Versions::both, done, "", kLoop, read_loop_subdivision},
    {"heightfield", Versions::v3, done, "", kHeightField, read_height_field},
    {"nurbs", Versions::v3, done, "29 x 29 patches of triangles, as pbrt-v3 has", kNurbs,
     read_nurbs},
};

}  // namespace

std::span<const Record<ReadShape>> mesh_shapes() {
  return kMeshes;
}

}  // namespace duet::pbrt
