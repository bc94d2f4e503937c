#include "evaluate/compare/linear_image.h"

#include <fmt/format.h>

#include <cmath>

#include "evaluate/report/aov_names.h"
#include "evaluate/report/denoised_image.h"
#include "image/colours.h"
#include "image/image_io.h"
#include "math/spectrum.h"

namespace duet {

LinearImage load_linear(const std::string& path) {
  ImageFile file = read_image(path);
  LinearImage linear;
  linear.image = std::move(file.image);
  take_combined_as_colours(linear.image.channels);
  linear.display_encoded = file.display_encoded;
  for (const auto& [name, value] : file.header) {
    if (name == "spp") linear.spp = value;
    if (name == kDenoiserField) linear.denoiser = value;
  }
  linear.header = std::move(file.header);
  if (!file.display_encoded) return linear;
  std::vector<float>& data = linear.image.data;
  if (!file.bytes.empty()) {
    data.resize(file.bytes.size());
    for (size_t i = 0; i < file.bytes.size(); ++i) data[i] = float(file.bytes[i]) / 255;
  }
  for (float& v : data) v = srgb_to_linear(v);
  return linear;
}

void check_finite(const Image& image, const std::string& path) {
  const Colours colours(image);
  for (size_t i = 0; i < colours.pixels(); ++i)
    for (int c = 0; c < 3; ++c)
      if (!std::isfinite(colours(i, c)))
        throw std::runtime_error(fmt::format("{} has values that are not finite", path));
}

void check_variance(const Image& image, const std::string& path) {
  check_finite(image, path);
  const Colours colours(image);
  double sum = 0;
  for (size_t i = 0; i < colours.pixels(); ++i)
    for (int c = 0; c < 3; ++c) sum += colours(i, c);
  if (sum < 0) throw std::runtime_error(fmt::format("{} is negative: it is no variance", path));
}

}  // namespace duet
