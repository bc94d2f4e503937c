// Raw films as slices of all samples, some of which may be lost.
#pragma once

#include <string>
#include <vector>

#include "evaluate/raw/merge.h"

namespace duet {

class ExpectedSlices {
 public:
  /// Nothing is known of them.
  ExpectedSlices() = default;
  /// `count` slices of `spp` samples per pixel; `command` renders one of them, with {slice} for its
  /// number, or is empty.
  ExpectedSlices(uint32_t count, uint32_t spp, std::string command)
      : count_(count), spp_(spp), command_(std::move(command)) {}

  /// Films that are not there are slices that are lost.
  void leave_out_missing(std::vector<std::string>& films) const;
  /// The samples that no film has, of those that are expected. Throws std::runtime_error if the
  /// films have no slices.
  std::vector<SampleInterval> gaps(const MergedFilms& merged) const;
  /// A sentence on each slice that is not complete.
  std::vector<std::string> incomplete(const SampleIntervals& samples) const;

 private:
  bool are_known() const { return count_ > 0; }

  uint32_t count_ = 0, spp_ = 0;
  std::string command_;
};

}  // namespace duet
