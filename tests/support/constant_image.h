// An image of one value.
#pragma once

#include "image/image.h"

namespace duet::test {

inline Image constant_image(int width, int height, float value) {
  Image image(width, height, {"R", "G", "B"});
  for (float& v : image.data) v = value;
  return image;
}

}  // namespace duet::test
