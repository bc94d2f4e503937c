// How far an image is from a reference, and whether noise explains it.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "image/image.h"

namespace duet {

/// What the z-test and the bias need to know. Variances are those of one sample.
struct NoiseModel {
  const Image* variance = nullptr;  ///< of the reference's estimator, per pixel
  double image_spp = 1, reference_spp = 1;
  /// Relative error of the reference that is not noise.
  double systematic = 1e-3;
};

/// All over the channels R, G and B of all pixels.
struct ImageMetrics {
  double rmse = 0;            ///< root of the mean of (a − b)²
  double relative_rmse = 0;   ///< rmse / mean(b); 0 of two black images
  double relmse = 0;          ///< mean of (a − b)² / (b² + 0.01)
  double relmse_trimmed = 0;  ///< the same without the worst 0.1 % of the pixels
  double mae = 0;             ///< mean of |a − b|
  double firefly = 0;  ///< share of the image's luminance that is in its brightest 0.1 % of pixels
  double worst = 0;    ///< share of relmse that is in the worst 0.1 % of the pixels
  /// mean(a) / mean(b) per channel; 1 where both are zero.
  std::array<double, 3> mean_ratio{};
  long nan_pixels = 0, infinite_pixels = 0, negative_pixels = 0;  ///< of the image
  /// Difference of the means over its standard error, the worst channel; with a noise model only.
  std::optional<double> bias;
  /// Share of values whose difference noise explains at significance 0.01, Šidák-corrected for the
  /// number of pixels.
  std::optional<double> z_share;
  /// Root mean square of the differences in standard errors.
  std::optional<double> z_rms;
};

/// The least z_share of an image whose noise is normal; it does not decide a verdict.
inline constexpr double kRequiredZShare = 0.9975;
/// The largest |bias| that is not notable; it does not decide a verdict either (bias_test.h does).
inline constexpr double kNotableBias = 4;

/// Both images must have channels R, G and B (or Y alone) and the same size; throws
/// std::invalid_argument otherwise. Pixels that are not finite are left out of all means.
ImageMetrics compare_images(const Image& image, const Image& reference,
                            const std::optional<NoiseModel>& noise);

/// Share of the pixels that the trimmed error leaves out and among which fireflies are looked for.
inline constexpr double kOutlierShare = 0.001;
/// How many of `pixels` stay when these are left out; at least one.
size_t trimmed_count(size_t pixels);
/// The share of the values' sum that the others have, the largest ones.
double brightest_share(std::vector<double> values);

/// Red where the image is brighter than the reference, blue where it is darker, white where equal;
/// full colour at a difference of `scale` in luminance. Three bytes per pixel.
std::vector<uint8_t> difference_image(const Image& image, const Image& reference, double scale);

/// Colours for values from 0 (black) over violet and orange to 1 (pale yellow), each lighter than
/// the one before; what is not a number is green. Three bytes per value.
std::vector<uint8_t> false_colours(const std::vector<float>& values);
/// Per pixel the difference of luminances relative to the reference's, |a − b| / (b + 0.01
/// mean(b)).
std::vector<float> relative_differences(const Image& image, const Image& reference);

}  // namespace duet
