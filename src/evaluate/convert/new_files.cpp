#include "evaluate/convert/new_files.h"

#include <fmt/format.h>

#include <filesystem>

#include "image/image_io.h"
#include "mesh/ply_writer.h"
#include "scene/bsdfs/measured.h"
#include "scene/features.h"

namespace duet {

namespace fs = std::filesystem;

NewFiles::NewFiles(std::string scene_file) {
  const fs::path path = fs::weakly_canonical(fs::absolute(scene_file));
  folder_ = path.parent_path().string();
  stem_ = fmt::format("{}-{}", path.stem().string(), path.extension().string().substr(1));
}

std::string NewFiles::relative(const std::string& path) const {
  if (path.empty() || made_.contains(path)) return path;
  return fs::weakly_canonical(fs::absolute(path)).lexically_proximate(folder_).string();
}

std::string NewFiles::add(std::string_view what, std::string_view extension, std::string bytes) {
  const auto counted = counts_.try_emplace(std::string(what), 0).first;
  const std::string name = fmt::format("{}-{}{}.{}", stem_, what, counted->second++, extension);
  made_.insert(name);
  files_.push_back({(fs::path(folder_) / name).string(), std::move(bytes)});
  return name;
}

std::string NewFiles::add_mesh(const std::shared_ptr<const TriangleMesh>& mesh) {
  const auto [entry, is_new] = meshes_.try_emplace(mesh.get());
  if (is_new) entry->second = add("mesh", "ply", ply_bytes(*mesh));
  return entry->second;
}

std::string NewFiles::add_image(std::string_view what, const Image& image) {
  ExrOptions options;
  options.half = false;
  const std::vector<uint8_t> bytes = exr_bytes(std::string(what), image, options);
  return add(what, "exr", std::string(bytes.begin(), bytes.end()));
}

void name_files_again(SceneDescription& scene, const NewFiles& files) {
  for (TextureDescription& t : scene.textures)
    if (auto* image = std::get_if<BitmapTexture>(&t.model))
      image->file = files.relative(image->file);
  for (LightDescription& l : scene.lights) {
    if (auto* map = std::get_if<EnvironmentMapLight>(&l.model))
      map->file = files.relative(map->file);
    if (auto* map = std::get_if<GoniometricLight>(&l.model)) map->file = files.relative(map->file);
  }
  for (VolumeDescription& v : scene.volumes) v.file = files.relative(v.file);
  for (MaterialDescription& m : scene.materials)
    if (const auto* measured = m.model.get_if<MeasuredMaterial>()) {
      MeasuredMaterial copy = *measured;
      copy.file = files.relative(copy.file);
      m.model = copy;
    }
  for_all_shapes(scene, [&](ShapeDescription& s) {
    if (auto* mesh = std::get_if<MeshShape>(&s.geometry)) {
      mesh->source->file = files.relative(mesh->source->file);
      mesh->source->pbrt_file = files.relative(mesh->source->pbrt_file);
    }
    if (auto* grid = std::get_if<SdfGridShape>(&s.geometry))
      grid->file = files.relative(grid->file);
    if (auto* curves = std::get_if<CurvesShape>(&s.geometry))
      curves->file = files.relative(curves->file);
  });
}

void count_passed_surfaces(SceneDescription& scene, bool counts, Losses& losses) {
  if (scene.counts_passed_surfaces == counts) return;
  const auto is_limited = []<class T>(const T& method) {
    if constexpr (requires { method.max_depth; })
      return !std::is_same_v<T, VolumePathIntegratorDescription> && method.max_depth >= 0;
    else
      return false;
  };
  if (scene_features(scene).masks > 0 && std::visit(is_limited, scene.integrator.method))
    losses.add(counts ? "surfaces that light passes straight through count for the depth of paths"
                      : "surfaces that light passes straight through count no longer for the depth "
                        "of paths");
  scene.counts_passed_surfaces = counts;
}

}  // namespace duet
