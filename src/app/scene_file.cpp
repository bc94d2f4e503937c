#include "app/scene_file.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <set>

#include "app/arguments.h"
#include "app/commands.h"
#include "app/program.h"
#include "app/scene_operand.h"
#include "evaluate/report/read_scene.h"

namespace duet {

namespace {

ReadingOptions reading_options(const ReadOptions& o, const Program& program) {
  ReadingOptions reading{{}, o.search_paths, o.methods, o.pbrt_version, {}};
  for (const std::string& define : o.defines)
    reading.defines.push_back(parse_assignment("-D", define));
  reading.files.read = [&program, on_disk = with_disk({}).read](const std::string& path) {
    return path == kStandardInput ? program.standard_input : on_disk(path);
  };
  return reading;
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
  const ReadingOptions reading = reading_options(options, program);
  std::set<std::string> names;
  for (const std::string& file : options.scenes) {
    const auto own = parameters_of_scene(file, reading);
    if (!own) return;
    names.insert(own->begin(), own->end());
  }
  for (const auto& [name, value] : reading.defines) {
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
  Diagnostics diagnostics;
  auto scene = read_scene(file, reading_options(options, program), diagnostics);
  report(diagnostics, options.strict, program.log);
  return std::move(scene.value());
}

}  // namespace duet
