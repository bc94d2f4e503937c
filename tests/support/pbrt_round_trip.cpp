#include "support/pbrt_round_trip.h"

#include <doctest/doctest.h>

#include <cmath>

#include "image/image_io.h"
#include "pbrt/pbrt.h"
#include "pbrt/writer.h"
#include "support/files.h"

namespace duet::test {

namespace {

constexpr const char* kPly =
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float "
    "z\n"
    "property float nx\nproperty float ny\nproperty float nz\nproperty float u\nproperty float v\n"
    "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
    "0 0 0 0 0 1 0 0\n1 0 0 0 0 1 1 0\n0 1 0 0 0 1 0 1\n3 0 1 2\n";

/// Both descriptions must have been read from files of the same names.
const TemporaryDirectory& folder() {
  static const TemporaryDirectory shared;
  static const bool is_ready = [] {
    Image image(4, 4, {"R", "G", "B"});
    for (size_t i = 0; i < image.data.size(); ++i) image.data[i] = float(i % 7) / 8;
    write_exr(shared.path("image.exr"), image, {});
    shared.write("mesh.ply", kPly);
    return true;
  }();
  (void)is_ready;
  return shared;
}

/// Whether two grids differ by no more than `tolerance` of their largest value.
bool is_close(const VolumeDescription& a, const VolumeDescription& b, float tolerance) {
  if (a.grid->size != b.grid->size || a.grid->channels != b.grid->channels) return false;
  float largest = 0, difference = 0;
  for (size_t i = 0; i < a.grid->values.size(); ++i) {
    largest = std::max(largest, std::abs(a.grid->values[i]));
    difference = std::max(difference, std::abs(a.grid->values[i] - b.grid->values[i]));
  }
  return a.to_world == b.to_world && difference <= tolerance * largest;
}

/// Normals are given length one again when they are read: those that are the same but for that are
/// taken from `from`. So are the tangents of bumps: where there are some, the writer says that they
/// are those of pbrt-v4.
void align_normals(ShapeDescription& s, const ShapeDescription& from) {
  auto* mesh = std::get_if<MeshShape>(&s.geometry);
  const auto* other = std::get_if<MeshShape>(&from.geometry);
  if (!mesh || !other || mesh->mesh->normals.size() != other->mesh->normals.size()) return;
  auto made = std::make_shared<TriangleMesh>(*mesh->mesh);
  for (size_t i = 0; i < made->normals.size(); ++i) {
    const Normal3f& n = other->mesh->normals[i];
    if (length_squared(Vector3f(made->normals[i]) - Vector3f(n)) < 1e-12f) made->normals[i] = n;
  }
  made->bump_tangents = other->mesh->bump_tangents;
  mesh->mesh = std::move(made);
}

}  // namespace

SceneDescription read_pbrt_text(const std::string& text, bool is_world) {
  const std::string file = folder().write(
      "scene.pbrt", is_world ? "Film \"rgb\"\nCamera \"orthographic\"\nWorldBegin\n" + text : text);
  Diagnostics diagnostics;
  auto read = pbrt::read_pbrt(file, {}, diagnostics);
  std::string messages;
  for (const Diagnostic& d : diagnostics.all())
    if (const std::string m = d.to_string(); m.find("approximated: ") == m.npos)
      messages += m + "\n";
  CHECK(messages == "");
  if (!read) throw std::runtime_error(messages + text);
  return std::move(read->description);
}

void check_pbrt_parts(const SceneDescription& a, const SceneDescription& b, float tolerance) {
  CHECK(a.textures == b.textures);
  CHECK(a.materials == b.materials);
  CHECK(a.phases == b.phases);
  CHECK(a.media == b.media);
  std::vector<ShapeDescription> shapes = b.shapes;
  for (size_t i = 0; i < std::min(a.shapes.size(), shapes.size()); ++i)
    align_normals(shapes[i], a.shapes[i]);
  CHECK(a.shapes == shapes);
  CHECK(a.groups == b.groups);
  CHECK(a.lights == b.lights);
  CHECK(a.sensors == b.sensors);
  // pbrt has no paths without a limit.
  const auto* walks = std::get_if<VolumePathIntegratorDescription>(&a.integrator.method);
  if (!walks || walks->max_depth >= 0) CHECK(a.integrator == b.integrator);
  REQUIRE(a.volumes.size() == b.volumes.size());
  if (tolerance == 0) CHECK(a.volumes == b.volumes);
  for (size_t i = 0; i < a.volumes.size(); ++i)
    CHECK(is_close(a.volumes[i], b.volumes[i], tolerance));
}

SceneDescription check_pbrt_round_trip(const std::string& world) {
  SceneDescription d = read_pbrt_text(world);
  const pbrt::PbrtText written = pbrt::write_pbrt(d);
  CAPTURE(written.text.substr(0, 3000));
  CHECK(written.losses == std::vector<std::string>{});
  check_pbrt_parts(d, read_pbrt_text(written.text, false));
  return d;
}

}  // namespace duet::test
