#include "scene/texture_texels.h"

#include <algorithm>
#include <sstream>

#include "image/image_facts.h"
#include "textures/bitmap_pixels.h"

namespace duet {

Spectrum TextureTexels::mean() const {
  std::array<double, 3> sum{};
  for (const Spectrum& c : colors)
    for (int k = 0; k < 3; ++k) sum[size_t(k)] += double(c[k]);
  const double n = double(std::max<size_t>(colors.size(), 1));
  return {float(sum[0] / n), float(sum[1] / n), float(sum[2] / n)};
}

Spectrum TextureTexels::largest() const {
  Spectrum most;
  for (const Spectrum& c : colors)
    for (int k = 0; k < 3; ++k) most[k] = std::max(most[k], c[k]);
  return most;
}

TextureTexels read_texels(const BitmapTexture& texture) {
  const BitmapPixels pixels = BitmapPixels::from_file(read_image(texture.file), texture.decoding());
  TextureTexels texels{pixels.width(), pixels.height(), {}};
  texels.colors.reserve(size_t(texels.width) * size_t(texels.height));
  for (int y = 0; y < texels.height; ++y)
    for (int x = 0; x < texels.width; ++x) texels.colors.push_back(pixels.color(x, y));
  return texels;
}

std::optional<std::array<double, 8>> image_chromaticities(const std::string& file) {
  std::array<double, 8> numbers;
  try {
    std::istringstream text(read_image_facts(file).field("chromaticities"));
    for (double& x : numbers)
      if (!(text >> x)) return std::nullopt;
  } catch (const ReadError&) {
    return std::nullopt;  // said when its pixels are read
  }
  return numbers;
}

}  // namespace duet
