// Exposures of files for display, as users write them.
#pragma once

#include <optional>
#include <string>

namespace duet {

/// Guards against slips of the pen, in stops.
inline constexpr double kMaxExposure = 100;

struct Exposure {
  double stops = 0;
  bool automatic = false;  ///< on top of what makes the mean of luminance middle grey
};

/// Of a number of stops from -kMaxExposure to kMaxExposure, of "auto", and of "auto+1" or "auto-1";
/// nothing of others.
std::optional<Exposure> exposure_of(const std::string& text);

/// What is said of others.
std::string not_an_exposure(const std::string& text);

}  // namespace duet
