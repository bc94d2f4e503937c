#include "app/scene_file.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <set>

#include "app/arguments.h"
#include "app/commands.h"
#include "app/program.h"
#include "app/scene_operand.h"
#include "files/file_access.h"
#include "pbrt/pbrt.h"

namespace duet {

namespace {

MitsubaOptions mitsuba_options(const ReadOptions& options, const Program& program) {
  MitsubaOptions mitsuba;
  mitsuba.search_paths = options.search_paths;
  for (const std::string& define : options.defines)
    mitsuba.defines.push_back(parse_assignment("-D", define));
  mitsuba.files.read = [&program, on_disk = with_disk({}).read](const std::string& path) {
    return path == kStandardInput ? program.standard_input : on_disk(path);
  };
  mitsuba.replacing_methods = options.methods;
  return mitsuba;
}

LoadedScene load_pbrt(const std::string& file, const ReadOptions& options, Program& program) {
  Diagnostics diagnostics;
  InputFiles files;
  pbrt::Options pbrt;
  if (options.pbrt_version != 0) pbrt.version = pbrt::Version(options.pbrt_version);
  pbrt.search_paths = options.search_paths;
  pbrt.replaces_integrator = !options.methods.empty();
  pbrt.exists = files.watch({}).exists;
  auto scene = pbrt::read_pbrt(file, pbrt, diagnostics);
  pbrt.exists = nullptr;
  report(diagnostics, options.strict, program.log);
  return {std::move(scene.value().description),
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

void add_read_options(CLI::App& c, ReadOptions& o) {
  c.add_option("scene", o.scenes,
               "Scene files; a folder means the scene.xml or the only .xml file in it, - means "
               "standard input")
      ->required()
      ->transform(scene_file_of);
  c.option_defaults()->group("Scene");
  c.add_option("-D,--define", o.defines, "NAME=VALUE of a $parameter of the scene; repeatable")
      ->allow_extra_args(false);
  c.add_option("-a,--path", o.search_paths, "Further directory to look for files; repeatable")
      ->allow_extra_args(false)
      ->check(CLI::ExistingDirectory);
  c.add_option("--pbrt-version", o.pbrt_version,
               "Version of pbrt that .pbrt files are for, 3 or 4; by default found from the file")
      ->check(CLI::IsMember({3, 4}));
  c.add_flag("--strict", o.strict, "Every warning is an error");
  c.option_defaults()->group("Options");
}

void check_defines(const ReadOptions& options, const Program& program) {
  if (options.defines.empty()) return;
  MitsubaOptions mitsuba = mitsuba_options(options, program);
  // Meshes have no parameters, and reading them twice would take long.
  mitsuba.files.read_mesh = some_mesh;
  mitsuba.files.read_obj_parts = [](const std::string& file, const MeshOptions& o) {
    return ObjFile{{{"", some_mesh("obj", file, o)}}, ""};
  };
  std::set<std::string> names;
  for (const std::string& file : options.scenes) {
    if (pbrt::is_pbrt_file(file)) continue;
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

void report(const Diagnostics& diagnostics, bool strict, Log& log) {
  const bool verbose = log.level() == Log::Level::verbose;
  for (const Diagnostic& d : verbose ? diagnostics.all() : diagnostics.summary())
    log.write(Log::Level::quiet, d.to_string());
  if (!diagnostics.has_errors() && !(strict && !diagnostics.all().empty())) return;
  if (!diagnostics.has_errors()) log.error("warnings are errors because of --strict");
  const auto first =
      std::find_if(diagnostics.all().begin(), diagnostics.all().end(), [&](const Diagnostic& d) {
        return d.severity == Severity::error || !diagnostics.has_errors();
      });
  throw SceneFailure(fmt::format("{}: {}", first->where.to_string(), first->message), true);
}

LoadedScene load_scene(const std::string& file, const ReadOptions& options, Program& program) {
  if (const std::string why = no_scene_reason(file, program.standard_input); !why.empty()) {
    program.log.error("cannot read {}: {}", file, why);
    throw SceneFailure(why, true);
  }
  if (pbrt::is_pbrt_file(file)) return load_pbrt(file, options, program);
  Diagnostics diagnostics;
  InputFiles files;
  MitsubaOptions mitsuba = mitsuba_options(options, program);
  mitsuba.files = files.watch(std::move(mitsuba.files));
  auto scene = read_mitsuba(file, mitsuba, diagnostics);
  report(diagnostics, options.strict, program.log);
  return {std::move(scene.value().description), std::move(scene->version),
          std::move(scene->parameters), std::move(files), diagnostics.all()};
}

}  // namespace duet
