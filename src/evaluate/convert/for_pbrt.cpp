// What pbrt-v4 has in another form than other formats.
#include <algorithm>
#include <cmath>

#include "evaluate/convert/new_files.h"
#include "lights/environment.h"

namespace duet {

namespace {

/// Whether normals that are made from faces are the same before and after the transform.
bool keeps_angles(const Matrix4& m) {
  double scale = 0;
  for (int i = 0; i < 3; ++i) scale += m[i][0] * m[i][0];
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 3; ++b) {
      double dot = 0;
      for (int i = 0; i < 3; ++i) dot += m[i][size_t(a)] * m[i][size_t(b)];
      if (std::abs(dot - (a == b ? scale : 0)) > 1e-5 * scale) return false;
    }
  return true;
}

/// pbrt reads PLY files with their own normals and coordinates alone.
void mesh_file(ShapeDescription& s, NewFiles& files) {
  auto* mesh = std::get_if<MeshShape>(&s.geometry);
  if (!mesh || !mesh->source->pbrt_file.empty()) return;
  const MeshSource& from = *mesh->source;
  const bool plain = from.plugin == "ply" && !from.flip_tex_coords && !from.max_smooth_angle &&
                     !mesh->mesh->computed_normals &&
                     from.face_normals == mesh->mesh->normals.empty();
  if (plain && !from.file.empty() && !mesh->mesh->normals.empty()) {
    mesh->source->pbrt_file = from.file;
    return;
  }
  if (mesh->mesh->computed_normals && s.motion.empty() && !keeps_angles(s.to_world)) {
    TriangleMesh placed = *mesh->mesh;
    transform_mesh(placed, s.to_world);
    placed.computed_normals = false;
    mesh->mesh = std::make_shared<const TriangleMesh>(std::move(placed));
    s.to_world = {};
  }
  // Few triangles stand in the scene itself.
  constexpr size_t kFew = 64;
  if (mesh->mesh->triangles.size() > kFew) mesh->source->pbrt_file = files.add_mesh(mesh->mesh);
}

void environment_file(SceneDescription& scene, LightDescription& l, NewFiles& files,
                      Losses& losses) {
  const auto* map = std::get_if<EnvironmentMapLight>(&l.model);
  if (!map && !std::holds_alternative<SkyLight>(l.model)) return;
  // Of the transform only the rotation counts, and pbrt takes all of it.
  const Frame axes = rotation(l.to_world);
  const std::array<Vector3f, 3> columns{axes.s, axes.t, Vector3f(axes.n)};
  l.to_world = {};
  for (size_t c = 0; c < 3; ++c) {
    l.to_world[0][c] = double(columns[c].x);
    l.to_world[1][c] = double(columns[c].y);
    l.to_world[2][c] = double(columns[c].z);
  }
  const bool grey = map && map->tint == Spectrum(map->tint.r);
  if (map && map->layout == EnvironmentLayout::equal_area && grey && !map->gamma && !map->colors)
    return;
  constexpr int kLargest = 2048, kSky = 1024;
  const int own = map ? environment_width(l) : kSky;
  const bool square = map && map->layout == EnvironmentLayout::equal_area;
  EnvironmentMapLight made;
  made.layout = EnvironmentLayout::equal_area;
  made.file = files.add_image("environment",
                              environment_image(scene, l, EnvironmentForm::equal_area,
                                                square ? own : std::clamp(own, 256, kLargest)));
  if (!square) losses.add("an environment is resampled to an image of equal areas");
  l.model = made;
}

}  // namespace

void prepare_for_pbrt(SceneDescription& scene, NewFiles& files, Losses& losses) {
  count_passed_surfaces(scene, false, losses);
  settle_image_colors(scene, files);
  settle_images_for_pbrt(scene);
  for (LightDescription& l : scene.lights) environment_file(scene, l, files, losses);
  for_all_shapes(scene, [&](ShapeDescription& s) { mesh_file(s, files); });
}

}  // namespace duet
