// Reads the three colours of a pixel wherever they stand among its channels.
#pragma once

#include <array>
#include <cstddef>
#include <stdexcept>

#include "image/image.h"

namespace duet {

/// Channels R, G, B; or Y alone, for a grey image. Throws std::invalid_argument without them.
class Colours {
 public:
  explicit Colours(const Image& image) : image_(&image) {
    const int y = image.find_channel("Y");
    index_ = {image.find_channel("R"), image.find_channel("G"), image.find_channel("B")};
    if (index_[0] < 0 && index_[1] < 0 && index_[2] < 0 && y >= 0) index_ = {y, y, y};
    if (index_[0] < 0 || index_[1] < 0 || index_[2] < 0)
      throw std::invalid_argument("the image has no channels R, G, B");
  }
  size_t pixels() const { return size_t(image_->width) * size_t(image_->height); }
  double operator()(size_t pixel, int channel) const {
    return image_->data[pixel * image_->channels.size() + size_t(index_[size_t(channel)])];
  }
  /// Of linear values with the primaries of sRGB (ITU-R BT.709).
  double luminance(size_t pixel) const {
    const Colours& c = *this;
    return 0.212671 * c(pixel, 0) + 0.715160 * c(pixel, 1) + 0.072169 * c(pixel, 2);
  }

 private:
  const Image* image_;
  std::array<int, 3> index_;
};

}  // namespace duet
