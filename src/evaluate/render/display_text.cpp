#include "evaluate/render/display_text.h"

#include <fmt/format.h>

namespace duet {

namespace {

std::string exposure_text(const DisplaySettings& s) {
  if (!s.automatic) return fmt::format("{}", s.exposure);
  return s.exposure == 0 ? "auto" : fmt::format("auto{:+}", s.exposure);
}

}  // namespace

std::vector<std::string> display_arguments(const DisplaySettings& settings) {
  std::vector<std::string> arguments;
  if (settings.exposure != 0 || settings.automatic)
    arguments.insert(arguments.end(), {"--exposure", exposure_text(settings)});
  if (settings.curve)
    arguments.insert(arguments.end(),
                     {"--tonemap", std::string(kToneCurveNames[size_t(*settings.curve)])});
  return arguments;
}

std::string display_text(const DisplaySettings& settings) {
  std::string text = "exposure " + exposure_text(settings);
  if (settings.curve) text += fmt::format(" tonemap {}", kToneCurveNames[size_t(*settings.curve)]);
  return text;
}

}  // namespace duet
