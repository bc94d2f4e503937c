#include "app/file_options.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "app/commands.h"
#include "evaluate/report/exposure.h"

namespace duet {

namespace {

/// The names of a table, as CLI11 checks them.
template <class Names>
CLI::IsMember one_of(const Names& names) {
  return CLI::IsMember(std::vector<std::string>(std::begin(names), std::end(names)));
}

void parse_exposure(const std::string& text, DisplaySettings& settings) {
  const std::optional<Exposure> exposure = exposure_of(text);
  if (!exposure) throw UsageError("--exposure: " + not_an_exposure(text));
  settings.exposure = exposure->stops;
  settings.automatic = exposure->automatic;
}

}  // namespace

void add_file_options(CLI::App& c, FileOptions& o) {
  c.add_option("--exposure", o.exposure,
               "Exposure of .png and .jpg, in stops; auto, or auto+1, makes the mean of luminance "
               "middle grey");
  c.add_option("--tonemap", o.tone_map,
               "How .png and .jpg show bright colours: srgb (cut off), aces, agx or reinhard "
               "(default: as the scene says, srgb)")
      ->check(one_of(kToneCurveNames));
  c.add_option("--png-depth", o.png_depth, "Bits of a value in .png: 8 or 16 (default: 8)")
      ->check(CLI::IsMember({"8", "16"}));
  c.add_option("--aov-names", o.aov_names,
               "Whose names the layers in .exr have: duet, blender, nuke or mitsuba (default: "
               "duet); docs/layers.md lists them")
      ->check(one_of(kAovNames));
  c.add_flag("--exr-parts", o.exr_parts,
             "Make each layer a part of its own in .exr, as viewers of images list them");
}

FileSettings parse_file_settings(const FileOptions& o) {
  FileSettings settings;
  parse_exposure(o.exposure, settings.display);
  if (!o.tone_map.empty()) settings.display.curve = tone_curve_of(o.tone_map);
  settings.display.png_depth = o.png_depth == "16" ? 16 : 8;
  settings.aov_names = aov_names_of(o.aov_names).value_or(AovNames::duet);
  settings.exr_parts = o.exr_parts;
  return settings;
}

}  // namespace duet
