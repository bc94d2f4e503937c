// What a method would do with a render's samples, from what the pilot's samples are worth under it.
// Source: Grittmann et al., "Efficiency-Aware Multiple Importance Sampling for Bidirectional
// Rendering Algorithms", SIGGRAPH 2022, for what one method's samples tell of another's variance.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>

#include "integrators/pricing_pilot.h"
#include "scene/description_integrators.h"

namespace duet {

/// Share of the pixels that the error leaves out, as `duet compare` does.
inline constexpr double kTrimmedPixels = 0.001;

/// Of the square of the image's mean, in what errors are relative to.
inline constexpr double kDarkShare = 0.1;

/// A method that may be chosen, by its multiples of the pilot's numbers of samples.
struct MethodCandidate {
  decltype(IntegratorDescription::method) method;
  std::string name;
  double light_paths = 0;    ///< per pixel
  bool connections = false;  ///< with all vertices of a light sub-path
  double merges = 0;         ///< light paths times merging area, over those of the pilot
  /// Nothing but merges at the first vertex that does not scatter by a delta lobe, and hits before.
  bool photons_only = false;
  /// Variance of what a group of pixels shares (PilotSample::shared) over that without groups.
  double shared_variance = 1;
};

/// What one part of the image adds to the figures of PredictedMethod, as far as they are sums.
struct PredictedPart {
  double missing = 0, rare = 0, merged = 0, variance = 0, error = 0;
  double blur = 0;  ///< is among the error; of so few sub-paths it may come out below zero
  double blur_variance = 0;
  double least_error = 0;  ///< what the error of the whole is bounded by from below
};

/// What a candidate would do with the render's samples.
struct PredictedMethod {
  double missing = 0;   ///< share of the light that it cannot find
  double rare = 0;      ///< share of the light that fewer than kTrimmedPixels would show
  double merged = 0;    ///< share of the light with smooth scattering that it finds by merging
  double variance = 0;  ///< of one sample per pixel, relative to the square of the image
  double blur = 0;      ///< mean squared relative error that merging adds: cautious_blur()
  double error = 0;     ///< mean squared relative error of the image
  double cost = 0;      ///< of one sample of one pixel
  std::vector<PredictedPart> parts;  ///< of MergeMask's grid, before variance is bounded from below
};

/// A sum of estimates of blur and one standard error: what a pilot cannot tell from no blur at all
/// is not to be had for nothing.
inline double cautious_blur(double sum, double variance) {
  return std::max(0.0, sum + std::sqrt(variance));
}

PredictedMethod predict(const PricingRecord& record, const MethodCandidate& candidate, int spp);

}  // namespace duet
