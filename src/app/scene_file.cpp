#include "app/scene_file.h"

#include "app/commands.h"
#include "base/log.h"
#include "mitsuba/mitsuba.h"

namespace duet {

bool report(const Diagnostics& diagnostics, bool strict, size_t& printed) {
  const std::vector<Diagnostic>& all = diagnostics.all();
  for (; printed < all.size(); ++printed) log::write(log::Level::quiet, all[printed].to_string());
  return diagnostics.has_errors() || (strict && !all.empty());
}

std::optional<LoadedScene> load_scene(const std::string& file, const ReadOptions& options) {
  MitsubaOptions mitsuba;
  mitsuba.search_paths = options.search_paths;
  for (const std::string& define : options.defines) {
    const size_t equals = define.find('=');
    if (equals == std::string::npos || equals == 0)
      throw UsageError(fmt::format("-D needs NAME=VALUE, not \"{}\"", define));
    mitsuba.defines.emplace_back(define.substr(0, equals), define.substr(equals + 1));
  }
  Diagnostics diagnostics;
  size_t printed = 0;
  auto scene = read_mitsuba(file, mitsuba, diagnostics);
  if (report(diagnostics, options.strict, printed) || !scene) {
    if (options.strict && !diagnostics.has_errors())
      log::error("{}: warnings are errors because of --strict", file);
    return std::nullopt;
  }
  return LoadedScene{std::move(scene->description), std::move(scene->parameters)};
}

}  // namespace duet
