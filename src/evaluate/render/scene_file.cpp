#include "evaluate/render/scene_file.h"

#include <algorithm>
#include <set>

#include "evaluate/render/assignment.h"
#include "evaluate/render/scene_operand.h"
#include "evaluate/report/read_scene.h"

namespace duet {

namespace {

ReadingOptions reading_options(const ReadOptions& o) {
  ReadingOptions reading{{}, o.search_paths, o.methods, o.pbrt_version, {}};
  for (const std::string& define : o.defines)
    reading.defines.push_back(parse_assignment("-D", define));
  reading.files.read = [&o, on_disk = with_disk({}).read](const std::string& path) {
    return path == kStandardInput ? o.standard_input : on_disk(path);
  };
  return reading;
}

}  // namespace

void check_defines(const ReadOptions& options) {
  if (options.defines.empty()) return;
  const ReadingOptions reading = reading_options(options);
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

void report(const Diagnostics& diagnostics, bool strict, Messages& messages) {
  const bool verbose = messages.level() == Messages::Level::verbose;
  for (const Diagnostic& d : verbose ? diagnostics.all() : diagnostics.summary())
    messages.write(Messages::Level::quiet, d.to_string());
  if (!diagnostics.has_errors() && !(strict && !diagnostics.all().empty())) return;
  if (!diagnostics.has_errors()) messages.error("warnings are errors because of --strict");
  const auto first =
      std::find_if(diagnostics.all().begin(), diagnostics.all().end(), [&](const Diagnostic& d) {
        return d.severity == Severity::error || !diagnostics.has_errors();
      });
  throw SceneFailure(fmt::format("{}: {}", first->where.to_string(), first->message), true);
}

LoadedScene load_scene(const std::string& file, const ReadOptions& options, Messages& messages) {
  if (const std::string why = no_scene_reason(file, options.standard_input); !why.empty()) {
    messages.error("cannot read {}: {}", file, why);
    throw SceneFailure(why, true);
  }
  Diagnostics diagnostics;
  auto scene = read_scene(file, reading_options(options), diagnostics);
  report(diagnostics, options.strict, messages);
  return std::move(scene.value());
}

}  // namespace duet
