// What Mitsuba 3 has in another form than other formats.
#include <algorithm>

#include "curves/curves_writer.h"
#include "evaluate/convert/new_files.h"
#include "mesh/ply_writer.h"
#include "pbrt/grid_cells.h"
#include "scene/displacement.h"
#include "volume/vol_writer.h"

namespace duet {

namespace {

/// Mitsuba 3 reads the file as this mesh.
bool has_file(const MeshSource& s) {
  return !s.file.empty() && !s.is_part && !s.max_smooth_angle;
}

/// The file of curves with radii that Mitsuba 3 reads: control points of B-splines that narrow
/// quickly have negative ones here.
std::string curves_file(const CurveSet& curves, Losses& losses) {
  const auto is_negative = [](const TubePoint& p) { return p.radius < 0; };
  if (std::none_of(curves.points.begin(), curves.points.end(), is_negative))
    return curves_text(curves);
  losses.add("curves that narrow quickly are wider towards their ends");
  CurveSet wider = curves;
  for (TubePoint& p : wider.points) p.radius = std::max(p.radius, 0.0f);
  return curves_text(wider);
}

void shape_files(ShapeDescription& s, NewFiles& files, Losses& losses) {
  if (auto* mesh = std::get_if<MeshShape>(&s.geometry); mesh && !has_file(*mesh->source)) {
    auto made = mesh->mesh;
    // Normals that Mitsuba makes, too, are left to it.
    if (made->computed_normals) {
      TriangleMesh plain = *made;
      plain.normals.clear();
      made = std::make_shared<const TriangleMesh>(std::move(plain));
    }
    mesh->source = MeshSource{};
    mesh->source->file = mesh->mesh->computed_normals ? files.add("mesh", "ply", ply_bytes(*made))
                                                      : files.add_mesh(mesh->mesh);
    mesh->source->plugin = "ply";
    mesh->source->flip_tex_coords = false;
    mesh->source->face_normals = mesh->mesh->normals.empty();
  }
  if (auto* curves = std::get_if<CurvesShape>(&s.geometry); curves && curves->file.empty())
    curves->file = files.add("curves", "txt", curves_file(*curves->curves, losses));
}

void volume_file(VolumeDescription& v, NewFiles& files, Losses& losses) {
  const auto& n = v.grid->size;
  if (v.nodes != VolumeNodes::within && v.file.empty()) {
    // The same nodes half a cell within a box that is larger by that.
    const int missing = int(v.nodes);
    std::array<double, 3> half;
    for (size_t i = 0; i < 3; ++i) half[i] = n[i] > 1 ? 0.5 * missing / (n[i] - missing) : 0;
    v.to_world = v.to_world * Matrix4::translate(-half[0], -half[1], -half[2]) *
                 Matrix4::scale(1 + 2 * half[0], 1 + 2 * half[1], 1 + 2 * half[2]);
    if (std::exchange(v.nodes, VolumeNodes::within) == VolumeNodes::beyond)
      losses.add("a grid fades out over half a cell beyond its box");
    else if (!pbrt::GridCells(v).fades())
      losses.add("a grid goes on for half a cell beyond its outermost values");
  }
  if (v.file.empty() && v.grid->node_count() > 1) {
    VolumeGrid grid = *v.grid;
    grid.lower = {0, 0, 0}, grid.upper = {1, 1, 1};
    v.file = files.add("grid", "vol", vol_bytes(grid));
  }
}

void environment(SceneDescription& scene, LightDescription& l, NewFiles& files, Losses& losses) {
  const auto* map = std::get_if<EnvironmentMapLight>(&l.model);
  if (!map) return;
  const bool has_form = map->layout == EnvironmentLayout::latitude_longitude;
  if (has_form && map->tint == Spectrum(1.0f) && !map->gamma && !map->illuminance && !map->colors)
    return;
  constexpr int kLargest = 4096;
  const int own = environment_width(l);
  const int width = map->layout == EnvironmentLayout::equal_area
                        ? std::clamp(4 * own, 512, kLargest)
                        : std::max(own, 2);
  EnvironmentMapLight made;
  made.file = files.add_image(
      "environment", environment_image(scene, l, EnvironmentForm::latitude_longitude, width));
  if (!has_form)
    losses.add(
        "an environment map is resampled to one by latitude and longitude, with rows at the poles");
  l.model = made;
}

void brighten(LightDescription& l, double factor) {
  const float f = float(factor);
  const auto change = [&]<class T>(T& m) {
    if constexpr (std::is_same_v<T, SkyLight>)
      m.sky_scale *= factor, m.sun_scale *= factor;
    else if constexpr (requires { m.intensity; })
      m.intensity *= f;
    else if constexpr (requires { m.radiance; })
      m.radiance *= f;
    else if constexpr (requires { m.power; })
      m.power *= f;
    else if constexpr (std::is_same_v<T, DirectionalLight>)
      m.irradiance *= f;
    else if constexpr (std::is_same_v<T, GoniometricLight>)
      m.scale *= f;
    else if constexpr (!std::is_same_v<T, ForeignLight>)
      m.scale *= factor;
  };
  std::visit(change, l.model);
}

/// Mitsuba's films have no exposure: as light adds up, it is the lights'.
void move_exposure_to_lights(SceneDescription& scene) {
  const auto& method = scene.integrator.method;
  if (scene.sensors.size() != 1 || !scene.sensors[0].film.response ||
      std::holds_alternative<OcclusionIntegratorDescription>(method) ||
      std::holds_alternative<DepthIntegratorDescription>(method))
    return;
  // How bright a foreign light is only it can say: the response is lost then, which is told.
  for (const LightDescription& l : scene.lights)
    if (std::holds_alternative<ForeignLight>(l.model)) return;
  const FilmResponse& r = *scene.sensors[0].film.response;
  const double factor = r[1][1];
  if (r != FilmResponse{{{factor, 0, 0}, {0, factor, 0}, {0, 0, factor}}}) return;
  scene.sensors[0].film.response.reset();
  for (LightDescription& l : scene.lights) brighten(l, factor);
  for_all_shapes(scene, [&](ShapeDescription& s) {
    if (!s.emission) return;
    if (auto* constant = std::get_if<Spectrum>(&s.emission->radiance)) {
      *constant *= float(factor);
      return;
    }
    const TextureId inner = std::get<TextureId>(s.emission->radiance);
    s.emission->radiance = TextureId(scene.textures.size());
    scene.textures.push_back(
        {s.emission->where, {}, ScaledTextureDescription{inner, Spectrum(float(factor))}});
  });
  for (MediumDescription& m : scene.media)
    if (m.emission)
      if (auto* constant = std::get_if<Spectrum>(&m.emission->radiance)) *constant *= float(factor);
}

}  // namespace

void prepare_for_mitsuba(SceneDescription& scene, NewFiles& files, Losses& losses) {
  displace_meshes(scene);
  count_passed_surfaces(scene, true, losses);
  move_exposure_to_lights(scene);
  settle_image_colors(scene, files);
  settle_images_for_mitsuba(scene);
  for (LightDescription& l : scene.lights) environment(scene, l, files, losses);
  for_all_shapes(scene, [&](ShapeDescription& s) { shape_files(s, files, losses); });
  for (VolumeDescription& v : scene.volumes) volume_file(v, files, losses);
}

}  // namespace duet
