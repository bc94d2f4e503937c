#include "media/volume_texture.h"

namespace duet {

VolumeTexture::VolumeTexture(const ColorVolumeSlot& volume)
    : volume_(volume), average_(volume.constant) {
  if (!volume.grid) return;
  // What surfaces see of the grid is not known; a few points of it say how bright it is.
  constexpr int kPoints = 8;
  average_ = Spectrum(0.0f);
  for (int i = 0; i < kPoints * kPoints * kPoints; ++i) {
    const auto at = [](int n) { return (float(n % kPoints) + 0.5f) / kPoints; };
    average_ += volume.grid->local_color({at(i), at(i / kPoints), at(i / (kPoints * kPoints))});
  }
  average_ = average_ / float(kPoints * kPoints * kPoints);
}

}  // namespace duet
