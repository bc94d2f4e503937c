#include "evaluate/render/file_settings_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "evaluate/report/image_file.h"

namespace duet {

namespace {

std::string exposure_text(const DisplaySettings& s) {
  if (!s.automatic) return fmt::format("{}", s.exposure);
  return s.exposure == 0 ? "auto" : fmt::format("auto{:+}", s.exposure);
}

std::vector<std::string> exr_arguments(const FileSettings& settings) {
  std::vector<std::string> arguments;
  if (settings.aov_names != AovNames::duet)
    arguments = {"--aov-names", std::string(kAovNames[size_t(settings.aov_names)])};
  if (settings.exr_parts) arguments.emplace_back("--exr-parts");
  return arguments;
}

}  // namespace

std::vector<std::string> file_arguments(const FileSettings& settings) {
  std::vector<std::string> arguments = exr_arguments(settings);
  const DisplaySettings& display = settings.display;
  if (display.exposure != 0 || display.automatic)
    arguments.insert(arguments.end(), {"--exposure", exposure_text(display)});
  if (display.curve)
    arguments.insert(arguments.end(),
                     {"--tonemap", std::string(kToneCurveNames[size_t(*display.curve)])});
  if (display.png_depth != 8)
    arguments.insert(arguments.end(), {"--png-depth", fmt::to_string(display.png_depth)});
  return arguments;
}

std::string file_settings_text(const std::string& path, const FileSettings& settings) {
  if (!is_display_format(path)) return fmt::format("{}", fmt::join(exr_arguments(settings), " "));
  const DisplaySettings& display = settings.display;
  std::string text = "exposure " + exposure_text(display);
  if (display.curve) text += fmt::format(" tonemap {}", kToneCurveNames[size_t(*display.curve)]);
  if (image_format(path) == "png" && display.png_depth != 8)
    text += fmt::format(" depth {}", display.png_depth);
  return text;
}

}  // namespace duet
