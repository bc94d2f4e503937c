// FLIP: how much of a difference a person sees who flips between two images.
// Sources: Andersson et al., "FLIP: A Difference Evaluator for Alternating Images", Proc. ACM CGIT
// 3(2), 2020 (LDR-FLIP); Andersson et al., "Visualizing Errors in Rendered High Dynamic Range
// Images", Eurographics Short Papers, 2021 (HDR-FLIP).
#pragma once

#include <optional>
#include <vector>

#include "image/image.h"

namespace duet {

/// Pixels per degree of visual angle: a display 0.7 m wide with 3840 pixels, seen from 0.7 m.
inline constexpr double kFlipPixelsPerDegree = 67.0206;

struct FlipResult {
  double mean = 0;         ///< from 0, no difference is seen, to 1
  std::vector<float> map;  ///< the same for each pixel, in rows from the top
};

/// LDR-FLIP of two images of equal size with linear values, of which a display shows 0 to 1: the
/// rest is cut off. Values that are not numbers count as 0. Throws std::invalid_argument if the
/// sizes differ or colours are missing.
FlipResult ldr_flip(const Image& image, const Image& reference);

/// The exposures in stops at which HDR-FLIP looks: `count` of them, at equal distances.
struct FlipExposures {
  double start = 0, stop = 0;
  int count = 2;
};
/// From the one that shows the brightest pixel of the reference just below white to the one that
/// does so with the median, in steps of about a stop. Empty if the reference is black.
std::optional<FlipExposures> flip_exposures(const Image& reference);

/// HDR-FLIP: the largest LDR-FLIP over all exposures, pixel by pixel. Empty if the reference is
/// black.
std::optional<FlipResult> hdr_flip(const Image& image, const Image& reference, int threads = 1);

}  // namespace duet
