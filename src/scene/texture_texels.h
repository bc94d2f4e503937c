// The texels of image textures, for those who have to know all of them.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "base/diagnostics.h"
#include "math/spectrum.h"
#include "scene/description.h"

namespace duet {

/// Linear colours in rows from the top.
struct TextureTexels {
  int width = 0, height = 0;
  std::vector<Spectrum> colors;

  Spectrum mean() const;
  /// Channel by channel.
  Spectrum largest() const;
};

/// Those of the texture's file, decoded as the texture says. Throws ReadError.
TextureTexels read_texels(const BitmapTexture& texture);

/// The chromaticities of red, green, blue and white that an OpenEXR file names, x before y. Nothing
/// if it names none, or cannot be read.
std::optional<std::array<double, 8>> image_chromaticities(const std::string& file);

}  // namespace duet
