// Which samples of a pixel there are.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace duet {

/// The samples first … end − 1.
struct SampleInterval {
  uint32_t first = 0, end = 0;
  uint32_t count() const { return end - first; }
  bool operator==(const SampleInterval&) const = default;
};

/// "0:256".
std::string to_string(const SampleInterval& interval);

/// A set of samples.
class SampleIntervals {
 public:
  /// In order, without overlaps, and as few as possible.
  const std::vector<SampleInterval>& all() const { return intervals_; }
  uint64_t count() const;
  bool overlaps(const SampleInterval& interval) const;
  /// What is added must not overlap what is there.
  void add(const SampleInterval& interval);
  /// What of an interval is not there.
  std::vector<SampleInterval> missing_from(const SampleInterval& interval) const;
  /// What there is before and behind an interval.
  std::vector<SampleInterval> outside_of(const SampleInterval& interval) const;
  /// What is missing before the last.
  std::vector<SampleInterval> gaps() const;
  bool operator==(const SampleIntervals&) const = default;

 private:
  std::vector<SampleInterval> intervals_;
};

/// "0:256, 512:768".
std::string to_string(const std::vector<SampleInterval>& intervals);

/// The k-th of n parts of the samples 0 … count − 1, counted from one, all of about the same
/// length.
SampleInterval slice_of(uint32_t count, uint32_t k, uint32_t n);

}  // namespace duet
