// Takes back what a denoiser has done where noise does not explain it.
#pragma once

#include <vector>

namespace duet {

/// An image and what is known of its noise: three values per pixel, in rows from the top.
struct ImageWithNoise {
  int width = 0, height = 0;
  std::vector<float> colour;
  std::vector<float> variance;  ///< estimates of the variance of `colour`
};

/// Moves the colours of a denoised image back to the noisy ones where the two differ by more than
/// noise does: by the share 1 − V / D, if that is positive, where D is the mean square of the
/// difference in the 5 x 5 pixels around and V the mean of the variance, both over the square of
/// the denoised colour. This is the positive part of an estimator of James and Stein ("Estimation
/// with quadratic loss", 1961), which shrinks the noisy colours towards the denoised ones.
void limit_bias(const ImageWithNoise& noisy, std::vector<float>& denoised);

}  // namespace duet
