// Sums that do not depend on the order of what is added.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

namespace duet {

/// A sum as an integer of 128 bits in units of 2⁻⁶⁴: adding integers is associative, so threads,
/// passes and films can be added in any order and any grouping and give the same bits. What is
/// added is rounded to a unit, once.
class ExactSum {
 public:
  /// What may be added at most, in absolute value: 2¹⁵ of these do not overflow.
  static constexpr double kLargest = 0x1p48;

  ExactSum() = default;
  /// By the words of the integer, in two's complement.
  ExactSum(uint64_t low, uint64_t high) : low_(low), high_(high) {}

  /// |x| must not be above kLargest, or not a number.
  void add(double x) {
    if (std::abs(x) < 0.5) {
      const auto fine = std::llrint(x * 0x1p64);
      return add_words(uint64_t(fine), uint64_t(fine >> 63));
    }
    // Above 2³⁰ the whole part apart, for 64 bits to be enough.
    if (!(std::abs(x) < 0x1p30)) {
      const auto whole = int64_t(x);
      high_ += uint64_t(whole);
      x -= double(whole);
    }
    const double scaled = x * 0x1p32;
    const auto coarse = int64_t(scaled);
    add_units(coarse, std::llrint((scaled - double(coarse)) * 0x1p32));
  }
  void add(const ExactSum& o) { add_words(o.low_, o.high_); }
  /// Adds coarse · 2⁻³² + fine · 2⁻⁶⁴.
  void add_units(int64_t coarse, int64_t fine) {
    add_words(uint64_t(coarse) << 32, uint64_t(coarse >> 32));
    add_words(uint64_t(fine), uint64_t(fine >> 63));
  }

  /// The sum as the nearest number, but for one rounding of its last bit.
  double value() const {
    const bool negative = int64_t(high_) < 0;
    const uint64_t low = negative ? ~low_ + 1 : low_;
    const uint64_t high = negative ? ~high_ + (low_ == 0) : high_;
    const double size = double(high) + double(low) * 0x1p-64;
    return negative ? -size : size;
  }

  /// The integer in two's complement, its lowest bits first: how files hold it.
  std::array<uint32_t, 4> words() const {
    return {uint32_t(low_), uint32_t(low_ >> 32), uint32_t(high_), uint32_t(high_ >> 32)};
  }
  static ExactSum from_words(const uint32_t* w) {
    return {uint64_t(w[1]) << 32 | w[0], uint64_t(w[3]) << 32 | w[2]};
  }

  bool operator==(const ExactSum&) const = default;

 private:
  void add_words(uint64_t low, uint64_t high) {
    low_ += low;
    high_ += high + (low_ < low);
  }

  uint64_t low_ = 0, high_ = 0;
};

}  // namespace duet
