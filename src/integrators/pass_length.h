// How many samples per pixel a pass takes, so that none lasts long whatever the budget.
#pragma once

#include <algorithm>

namespace duet {

/// Begins with one sample and doubles until a pass takes about as long as it may.
class PassLength {
 public:
  explicit PassLength(double seconds) : seconds_(seconds) {}
  /// Samples per pixel of the next pass, from 1 to `most`, that should last no longer than
  /// `seconds_left`.
  int next(int most, double seconds_left) const {
    const double wanted =
        std::min({2.0 * last_, std::min(seconds_, seconds_left) / seconds_per_sample_});
    return int(std::clamp(wanted, 1.0, double(most)));
  }
  void took(int samples, double seconds) {
    last_ = samples;
    seconds_per_sample_ = std::max(seconds / samples, 1e-9);
  }

 private:
  double seconds_;
  double last_ = 0.5;
  double seconds_per_sample_ = 1e-9;
};

}  // namespace duet
