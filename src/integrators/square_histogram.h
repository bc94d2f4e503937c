// Which contributions are so rare that few pixels ever get one.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

namespace duet {

/// Squared contributions by their size, in half octaves.
class SquareHistogram {
 public:
  void add(double square, double rate) {
    Bin& b = bins_[index(square)];
    b.squares += square * rate, b.rate += rate;
  }
  /// The square above which contributions are so rare that all of them together happen `rate`
  /// times.
  double limit(double rate) const {
    double sum = 0;
    for (int i = kBins - 1; i >= 0; --i) {
      sum += bins_[size_t(i)].rate;
      if (sum > rate) return std::exp2(0.5 * (i + 1) - kOffset);
    }
    return std::exp2(-kOffset);
  }

 private:
  static constexpr int kBins = 400, kOffset = 100;
  static size_t index(double square) {
    const double i = 2 * (std::log2(std::max(square, 1e-30)) + kOffset);
    return size_t(std::clamp(i, 0.0, double(kBins - 1)));
  }
  struct Bin {
    double squares = 0, rate = 0;
  };
  std::array<Bin, kBins> bins_{};
};

}  // namespace duet
