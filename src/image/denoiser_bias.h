// Takes back what a denoiser has done where noise does not explain it.
#pragma once

#include <functional>
#include <vector>

namespace duet {

/// An image and what is known of its noise: three values per pixel, in rows from the top.
struct ImageWithNoise {
  int width = 0, height = 0;
  std::vector<float> colour;
  /// Noise as that of `colour`, but independent of it: the squares estimate its variance.
  std::vector<float> noise;
};

/// Makes another image of one with as many values.
using DenoiseColours = std::function<std::vector<float>(std::vector<float>)>;

/// Moves the colours of a denoised image back to the noisy ones where the two differ by more than
/// the noise that was taken: by the share 1 − (V − C) / D between 0 and 1. All are means over the
/// 5 x 5 pixels around, divided by the square of the denoised colour: D of the squared difference,
/// V of the noise's variance, and C of the covariance of the denoised and the noisy colours, which
/// is the noise that the denoiser has kept. C comes from what `denoise`, which has made `denoised`
/// of the noisy colours, makes of them with half the known noise added. V − C is lessened by the
/// square of what is not seen, 0.003.
///
/// The share is that whose mean square error is least by Stein's estimate of it ("Estimation of the
/// mean of a multivariate normal distribution", 1981); C as in Ramani, Blu and Unser ("Monte-Carlo
/// SURE", 2008), with the noise itself in place of a random direction.
void limit_bias(const ImageWithNoise& noisy, const DenoiseColours& denoise,
                std::vector<float>& denoised);

}  // namespace duet
