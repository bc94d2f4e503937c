#include "app/scene_file.h"

#include <CLI/CLI.hpp>
#include <set>

#include "app/arguments.h"
#include "app/commands.h"
#include "base/log.h"
#include "mitsuba/mitsuba.h"

namespace duet {

namespace {

MitsubaOptions mitsuba_options(const ReadOptions& options) {
  MitsubaOptions mitsuba;
  mitsuba.search_paths = options.search_paths;
  for (const std::string& define : options.defines)
    mitsuba.defines.push_back(parse_assignment("-D", define));
  mitsuba.replacing_methods = options.methods;
  return mitsuba;
}

/// One triangle, for those who do not look.
TriangleMesh some_mesh(const std::string&, const std::string&, const MeshOptions&) {
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}};
  return mesh;
}

}  // namespace

void add_read_options(CLI::App& c, ReadOptions& o) {
  c.add_option("scene", o.scenes, "Scene files")->required();
  c.add_option("-D,--define", o.defines, "NAME=VALUE of a $parameter of the scene; repeatable")
      ->allow_extra_args(false);
  c.add_option("-a,--path", o.search_paths, "Further directory to look for files; repeatable")
      ->allow_extra_args(false)
      ->check(CLI::ExistingDirectory);
  c.add_flag("--strict", o.strict, "Every warning is an error");
}

void check_defines(const ReadOptions& options) {
  if (options.defines.empty()) return;
  MitsubaOptions mitsuba = mitsuba_options(options);
  // Meshes have no parameters, and reading them twice would take long.
  mitsuba.files.read_mesh = some_mesh;
  mitsuba.files.read_obj_parts = [](const std::string& file, const MeshOptions& o) {
    return ObjFile{{{"", some_mesh("obj", file, o)}}, ""};
  };
  std::set<std::string> names;
  for (const std::string& file : options.scenes) {
    Diagnostics ignored;
    const auto scene = read_mitsuba(file, mitsuba, ignored);
    if (!scene) return;
    for (const auto& [name, value] : scene->parameters) names.insert(name);
  }
  for (const auto& [name, value] : mitsuba.defines) {
    if (names.contains(name)) continue;
    const std::vector<std::string> known(names.begin(), names.end());
    std::string list;
    for (const std::string& n : known) list += (list.empty() ? "$" : ", $") + n;
    throw UsageError(fmt::format("-D {}={}: no scene has a parameter ${}{}; {}", name, value, name,
                                 did_you_mean(name, known),
                                 list.empty() ? "there are none" : "there are " + list));
  }
}

bool report(const Diagnostics& diagnostics, bool strict) {
  const bool verbose = log::level() == log::Level::verbose;
  for (const Diagnostic& d : verbose ? diagnostics.all() : diagnostics.summary())
    log::write(log::Level::quiet, d.to_string());
  return diagnostics.has_errors() || (strict && !diagnostics.all().empty());
}

std::optional<LoadedScene> load_scene(const std::string& file, const ReadOptions& options) {
  Diagnostics diagnostics;
  auto scene = read_mitsuba(file, mitsuba_options(options), diagnostics);
  if (report(diagnostics, options.strict) || !scene) {
    if (options.strict && !diagnostics.has_errors())
      log::error("{}: warnings are errors because of --strict", file);
    return std::nullopt;
  }
  return LoadedScene{std::move(scene->description), std::move(scene->parameters)};
}

}  // namespace duet
