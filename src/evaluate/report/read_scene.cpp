#include "evaluate/report/read_scene.h"

#include <algorithm>
#include <cstdlib>
#include <string_view>

#include "mitsuba/mitsuba.h"
#include "pbrt/pbrt.h"

namespace duet {

namespace {

std::vector<std::string> all_search_paths(const ReadingOptions& options) {
  std::vector<std::string> paths = options.search_paths;
  const char* const more = std::getenv(kPathVariable);
  for (std::string_view rest = more ? more : ""; !rest.empty();) {
    const size_t colon = std::min(rest.find(':'), rest.size());
    if (colon > 0) paths.emplace_back(rest.substr(0, colon));
    rest.remove_prefix(std::min(colon + 1, rest.size()));
  }
  return paths;
}

MitsubaOptions mitsuba_options(const ReadingOptions& options) {
  MitsubaOptions mitsuba;
  mitsuba.search_paths = all_search_paths(options);
  mitsuba.defines = options.defines;
  mitsuba.replacing_methods = options.methods;
  mitsuba.files = options.files;
  return mitsuba;
}

std::optional<LoadedScene> read_pbrt_scene(const std::string& file, const ReadingOptions& options,
                                           Diagnostics& diagnostics) {
  InputFiles files;
  pbrt::Options pbrt;
  if (options.pbrt_version != 0) pbrt.version = pbrt::Version(options.pbrt_version);
  pbrt.search_paths = all_search_paths(options);
  pbrt.replaces_integrator = !options.methods.empty();
  pbrt.exists = files.watch({}).exists;
  auto scene = pbrt::read_pbrt(file, pbrt, diagnostics);
  pbrt.exists = nullptr;
  if (!scene) return std::nullopt;
  return LoadedScene{std::move(scene->description),
                     fmt::format("pbrt-v{}", int(scene->version)),
                     {},
                     std::move(files),
                     diagnostics.all()};
}

/// One triangle, for those who do not look.
TriangleMesh some_mesh(const std::string&, const std::string&, const MeshOptions&) {
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}};
  return mesh;
}

}  // namespace

std::optional<LoadedScene> read_scene(const std::string& file, const ReadingOptions& options,
                                      Diagnostics& diagnostics) {
  if (pbrt::is_pbrt_file(file)) return read_pbrt_scene(file, options, diagnostics);
  InputFiles files;
  MitsubaOptions mitsuba = mitsuba_options(options);
  mitsuba.files = files.watch(std::move(mitsuba.files));
  auto scene = read_mitsuba(file, mitsuba, diagnostics);
  if (!scene) return std::nullopt;
  return LoadedScene{std::move(scene->description), std::move(scene->version),
                     std::move(scene->parameters), std::move(files), diagnostics.all()};
}

std::optional<std::vector<std::string>> parameters_of_scene(const std::string& file,
                                                            const ReadingOptions& options) {
  std::vector<std::string> names;
  if (pbrt::is_pbrt_file(file)) return names;
  MitsubaOptions mitsuba = mitsuba_options(options);
  // Meshes have no parameters, and reading them twice would take long.
  mitsuba.files.read_mesh = some_mesh;
  mitsuba.files.read_obj_parts = [](const std::string& path, const MeshOptions& o) {
    return ObjFile{{{"", some_mesh("obj", path, o)}}, ""};
  };
  Diagnostics ignored;
  const auto scene = read_mitsuba(file, mitsuba, ignored);
  if (!scene) return std::nullopt;
  for (const auto& [name, value] : scene->parameters) names.push_back(name);
  return names;
}

}  // namespace duet
