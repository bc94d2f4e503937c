#include "app/display_options.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "app/arguments.h"
#include "app/commands.h"

namespace duet {

namespace {

constexpr const char* kAutomatic = "auto";

}  // namespace

void add_display_options(CLI::App& c, std::string& exposure, std::string& tone_map) {
  c.add_option("--exposure", exposure,
               "Exposure of .png and .jpg, in stops; auto, or auto+1, makes the mean of luminance "
               "middle grey");
  c.add_option("--tonemap", tone_map,
               "How .png and .jpg show bright colours: srgb (cut off), aces, agx or reinhard "
               "(default: as the scene says, srgb)")
      ->check(CLI::IsMember(
          std::vector<std::string>(std::begin(kToneCurveNames), std::end(kToneCurveNames))));
}

DisplaySettings parse_display(const std::string& exposure, const std::string& tone_map) {
  DisplaySettings settings;
  std::string stops = exposure;
  if (stops.starts_with(kAutomatic)) {
    settings.automatic = true;
    stops.erase(0, 4);
    if (stops.empty()) stops = "0";
    // "auto2" is a slip of the pen.
    else if (stops[0] != '+' && stops[0] != '-')
      stops = exposure;
    else if (stops[0] == '+')
      stops.erase(0, 1);
  }
  settings.exposure = parse_amount("--exposure", stops, {{"", 1}}, -100, 100);
  if (!tone_map.empty()) settings.curve = tone_curve_of(tone_map);
  return settings;
}

}  // namespace duet
