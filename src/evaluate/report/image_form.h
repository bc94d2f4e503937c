// How an image is to be written, as its film asks for it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "image/film.h"
#include "scene/description.h"

namespace duet {

struct ImageForm {
  PixelBounds crop;
  Point2i full_size;
  PixelFormat pixel_format = PixelFormat::rgba;
  bool half = true;
  std::vector<std::string> full_precision;  ///< channels that half floats cannot hold
  std::optional<ToneMapping> tone_mapping;
};

}  // namespace duet
