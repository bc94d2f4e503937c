// The texels of image textures, for those who have to know all of them.
#pragma once

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

}  // namespace duet
