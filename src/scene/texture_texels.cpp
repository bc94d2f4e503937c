#include "scene/texture_texels.h"

#include <algorithm>
#include <array>

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
  const BitmapPixels pixels = BitmapPixels::from_file(
      read_image(texture.file),
      {.raw = texture.raw, .gamma = texture.gamma, .channel = texture.channel});
  TextureTexels texels{pixels.width(), pixels.height(), {}};
  texels.colors.reserve(size_t(texels.width) * size_t(texels.height));
  for (int y = 0; y < texels.height; ++y)
    for (int x = 0; x < texels.width; ++x) texels.colors.push_back(pixels.color(x, y));
  return texels;
}

}  // namespace duet
