// Shapes by their names.
#include <cmath>
#include <limits>
#include <map>

#include "mesh/mesh_file.h"
#include "pbrt/curves.h"
#include "pbrt/records.h"
#include "pbrt/shapes.h"
#include "pbrt/values.h"
#include "pbrt/vocabulary.h"
#include "values/text.h"

namespace duet::pbrt {

namespace {

using enum Status;

std::shared_ptr<const TriangleMesh> shared(TriangleMesh mesh) {
  return std::make_shared<const TriangleMesh>(std::move(mesh));
}

void add_mesh(Values& v, TriangleMesh mesh, bool own_normals) {
  if (mesh.triangles.empty()) {
    v.reader().report().warning(v.where(), "this shape has no area and is left out");
    return;
  }
  v.reader().add_shape(
      v.plugin(), {.geometry = MeshShape{shared(std::move(mesh)), {}}, .has_normals = own_normals});
}

std::vector<Point3f> points(Values& v, std::string_view name) {
  std::vector<Point3f> result;
  const Parameter* p = v.given(name);
  if (!p) return result;
  result.reserve(p->numbers.size() / 3);
  for (size_t i = 0; i + 2 < p->numbers.size(); i += 3)
    result.push_back({float(p->numbers[i]), float(p->numbers[i + 1]), float(p->numbers[i + 2])});
  return result;
}

std::vector<Normal3f> normals(Values& v) {
  std::vector<Normal3f> result;
  for (const Point3f& p : points(v, "N"))
    result.push_back(normalized_or_zero(Normal3f(p.x, p.y, p.z)));
  return result;
}

std::vector<Point2f> texture_coordinates(Values& v) {
  std::vector<Point2f> result;
  const Parameter* p = v.given("uv");
  if (!p) p = v.given("st");
  if (!p) return result;
  result.reserve(p->numbers.size() / 2);
  for (size_t i = 0; i + 1 < p->numbers.size(); i += 2)
    result.push_back({float(p->numbers[i]), float(p->numbers[i + 1])});
  return result;
}

/// Groups of N indices below `count`; nothing, after an error, if they are not.
template <size_t N>
std::optional<std::vector<std::array<uint32_t, N>>> indices(Values& v, size_t count) {
  std::vector<std::array<uint32_t, N>> result;
  Report& report = v.reader().report();
  const Parameter* p = v.given("indices");
  if (!p) {
    if (count != N) {
      report.error(v.where(), "\"integer indices\" is needed: there are {} points", count);
      return std::nullopt;
    }
    std::array<uint32_t, N> all;
    for (size_t i = 0; i < N; ++i) all[i] = uint32_t(i);
    result.push_back(all);
    return result;
  }
  if (p->numbers.size() % N != 0) {
    report.error(p->where, "the number of indices, {}, is no multiple of {}", p->numbers.size(), N);
    return std::nullopt;
  }
  result.resize(p->numbers.size() / N);
  for (size_t i = 0; i < p->numbers.size(); ++i) {
    const double index = p->numbers[i];
    if (!(index >= 0 && index < double(count))) {
      report.error(p->where, "index {} names no point: there are {}", index, count);
      return std::nullopt;
    }
    result[i / N][i % N] = uint32_t(index);
  }
  return result;
}

/// Whether `values` has as many entries as there are points, or none; an error if not.
template <class T>
bool matches(Values& v, const std::vector<T>& values, std::string_view name, size_t count) {
  if (values.empty() || values.size() == count) return true;
  v.reader().report().error(v.where(name), "there are {} \"{}\", but {} points", values.size(),
                            name, count);
  return false;
}

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
  mesh.positions = points(v, "P");
  if (mesh.positions.empty()) {
    v.reader().report().error(v.where(), "\"point3 P\" is needed");
    return;
  }
  auto triangles = indices<3>(v, mesh.positions.size());
  if (!triangles) return;
  mesh.triangles = std::move(*triangles);
  mesh.normals = normals(v);
  mesh.uvs = texture_coordinates(v);
  if (!matches(v, mesh.normals, "N", mesh.positions.size()) ||
      !matches(v, mesh.uvs, v.has("uv") ? "uv" : "st", mesh.positions.size()))
    return;
  finish_triangles(mesh, v.reader().needs_uv(v.plugin()));
  const bool own_normals = !mesh.normals.empty();
  add_mesh(v, std::move(mesh), own_normals);
}

constexpr Spec kBilinearMesh[] = {
    {"indices", kInteger, "", "four per patch; optional for four points", 0},
    {"P", kPoint3, "", "positions", 0},
    {"N", kNormal, "", "normals", 0},
    {"uv", kPoint2, "", "texture coordinates", 0},
    {"faceIndices", kInteger, "", "", 0, inert},
    {"emissionfilename", kString, "", "", 1, ignored},
};

void read_bilinear_mesh(Values& v) {
  PatchMesh mesh;
  mesh.positions = points(v, "P");
  if (mesh.positions.empty()) {
    v.reader().report().error(v.where(), "\"point3 P\" is needed");
    return;
  }
  auto patches = indices<4>(v, mesh.positions.size());
  if (!patches) return;
  mesh.patches = std::move(*patches);
  mesh.normals = normals(v);
  mesh.uvs = texture_coordinates(v);
  if (!matches(v, mesh.normals, "N", mesh.positions.size()) ||
      !matches(v, mesh.uvs, "uv", mesh.positions.size()))
    return;
  TriangleMesh triangles;
  append_patches(mesh, triangles);
  add_mesh(v, std::move(triangles), true);
}

constexpr Spec kPlyMesh[] = {
    {"filename", kString, "", "a .ply or .ply.gz file"},
    {"displacement", kTexture, "", "of the surface itself", 1, refused},
    {"edgelength", kNumber, "1", "", 1, inert},
};

void read_ply_mesh(Values& v) {
  if (!v.has("filename")) {
    v.reader().report().error(v.where(), "\"string filename\" is needed");
    return;
  }
  const std::string path = v.file("filename");
  if (path.empty()) return;
  const bool uv = v.reader().needs_uv(v.plugin());
  const auto mesh = v.reader().ply_mesh(path, uv, v.where("filename"));
  if (!mesh) return;
  const bool own_normals = mesh->own_normals;
  MeshSource source;
  if (mesh->is_whole_file) {
    source.file = path;
    source.plugin = "ply";
    source.flip_tex_coords = false;
  }
  v.reader().add_shape(v.plugin(),
                       {.geometry = MeshShape{mesh->mesh, source}, .has_normals = own_normals});
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
  const double phi = std::clamp(v.number("phimax"), 0.0, 360.0);
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
               phi = std::clamp(v.number("phimax"), 0.0, 360.0);
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
               height = v.number("height"), phi = std::clamp(v.number("phimax"), 0.0, 360.0);
  if (inner == 0 && phi == 360 && !v.reader().needs_uv(v.plugin()))
    v.reader().add_shape(v.plugin(),
                         {.geometry = DiskShape{},
                          .to_object = Matrix4::translate(0, 0, height) * Matrix4::scale(r, r, 1)});
  else
    add_mesh(v, make_disk(r, inner, height, phi), false);
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
  add_mesh(v, subdivide_loop(positions, *triangles, levels), true);
}

constexpr Spec kCurve[] = {
    {"P", kPoint3, "", "control points", 0},
    {"type", kString, "flat", "flat, cylinder or ribbon: all are tubes here"},
    {"basis", kString, "bezier", "bezier or bspline"},
    {"degree", kInteger, "3", "2 or 3"},
    {"width", kNumber, "1", "diameter of the tube"},
    {"width0", kNumber, "", "at the beginning"},
    {"width1", kNumber, "", "at the end"},
    {"N", kNormal, "", "of ribbons", 0, ignored},
    {"splitdepth", kInteger, "3", "", 1, inert},
};

void read_curve(Values& v) {
  Report& report = v.reader().report();
  CurvePoints curve;
  const std::vector<double> p = v.numbers("P");
  for (size_t i = 0; i + 2 < p.size(); i += 3) curve.points.push_back({p[i], p[i + 1], p[i + 2]});
  curve.degree = v.integer("degree");
  const std::string basis = v.string("basis"), type = v.string("type");
  curve.bspline = basis == "bspline";
  if (basis != "bezier" && basis != "bspline")
    report.error(v.where("basis"), "a curve's basis is bezier or bspline, not {}",
                 in_quotes(basis));
  if (type != "flat" && type != "cylinder" && type != "ribbon")
    report.error(v.where("type"), "a curve's type is flat, cylinder or ribbon, not {}",
                 in_quotes(type));
  else if (type != "cylinder")
    v.reader().approximate(v.where("type"), fmt::format("{} curves by round tubes", type));
  const double width = v.number("width");
  curve.width0 = v.has("width0") ? v.number("width0") : width;
  curve.width1 = v.has("width1") ? v.number("width1") : width;
  if (const std::string why = check_curve(curve); !why.empty()) {
    report.error(v.where("P"), "{}", why);
    return;
  }
  CurveSet tubes = make_tubes(curve);
  // Tubes keep their radii under transforms, and pbrt's widths stretch.
  const double scale = std::cbrt(std::abs(v.reader().state().ctm[0].determinant3()));
  for (TubePoint& t : tubes.points) t.radius *= float(scale);
  v.reader().add_shape(v.plugin(), {.geometry = CurvesShape{
                                        std::make_shared<const CurveSet>(std::move(tubes)), ""}});
}

constexpr Record<void (*)(Values&)> kShapes[] = {
    {"sphere", Versions::both, done, "parts of one become triangles", kSphere, read_sphere},
    {"cylinder", Versions::both, done, "parts of one become triangles", kCylinder, read_cylinder},
    {"disk", Versions::both, done, "rings and parts become triangles", kDisk, read_disk},
    {"trianglemesh", Versions::both, done, "", kTriangleMesh, read_triangle_mesh},
    {"plymesh", Versions::both, done, "faces of four corners are bilinear patches", kPlyMesh,
     read_ply_mesh},
    {"bilinearmesh", Versions::v4, done, "patches that are not flat become triangles",
     kBilinearMesh, read_bilinear_mesh},
    {"loopsubdiv", Versions::both, done, "", kLoop, read_loop_subdivision},
    {"curve", Versions::both, approximated, "round tubes, also where pbrt has ribbons", kCurve,
     read_curve},
};

}  // namespace

void read_shape(Reader& reader, const Plugin& plugin) {
  if (const auto* record = find_record<void (*)(Values&)>(reader, plugin, kShapes)) {
    Values values(reader, plugin, record->parameters, kShapeSpecs);
    record->read(values);
  }
}

void list_shapes(std::vector<Row>& rows) {
  list(rows, "Shape", kShapes, kShapeSpecs);
}

}  // namespace duet::pbrt
