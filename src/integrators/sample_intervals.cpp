#include "integrators/sample_intervals.h"

#include <fmt/format.h>

#include <algorithm>

namespace duet {

std::string to_string(const SampleInterval& interval) {
  return fmt::format("{}:{}", interval.first, interval.end);
}

std::string to_string(const std::vector<SampleInterval>& intervals) {
  std::string text;
  for (const SampleInterval& i : intervals) text += (text.empty() ? "" : ", ") + to_string(i);
  return text;
}

uint64_t SampleIntervals::count() const {
  uint64_t n = 0;
  for (const SampleInterval& i : intervals_) n += i.count();
  return n;
}

bool SampleIntervals::overlaps(const SampleInterval& interval) const {
  return interval.count() > 0 &&
         std::any_of(intervals_.begin(), intervals_.end(), [&](const SampleInterval& i) {
           return i.first < interval.end && interval.first < i.end;
         });
}

void SampleIntervals::add(const SampleInterval& interval) {
  if (interval.count() == 0) return;
  intervals_.push_back(interval);
  std::sort(intervals_.begin(), intervals_.end(),
            [](const SampleInterval& a, const SampleInterval& b) { return a.first < b.first; });
  std::vector<SampleInterval> joined;
  for (const SampleInterval& i : intervals_)
    if (!joined.empty() && joined.back().end == i.first)
      joined.back().end = i.end;
    else
      joined.push_back(i);
  intervals_ = std::move(joined);
}

std::vector<SampleInterval> SampleIntervals::missing_from(const SampleInterval& interval) const {
  std::vector<SampleInterval> missing;
  uint32_t at = interval.first;
  for (const SampleInterval& i : intervals_) {
    if (i.end <= at) continue;
    if (i.first >= interval.end) break;
    if (i.first > at) missing.push_back({at, i.first});
    at = i.end;
  }
  if (at < interval.end) missing.push_back({at, interval.end});
  return missing;
}

std::vector<SampleInterval> SampleIntervals::outside_of(const SampleInterval& interval) const {
  std::vector<SampleInterval> outside;
  for (const SampleInterval& i : intervals_) {
    const SampleInterval before{i.first, std::min(i.end, interval.first)};
    const SampleInterval behind{std::max(i.first, interval.end), i.end};
    for (const SampleInterval& part : {before, behind})
      if (part.first < part.end) outside.push_back(part);
  }
  return outside;
}

std::vector<SampleInterval> SampleIntervals::gaps() const {
  if (intervals_.empty()) return {};
  return missing_from({0, intervals_.back().end});
}

SampleInterval slice_of(uint32_t count, uint32_t k, uint32_t n) {
  return {uint32_t(uint64_t(count) * (k - 1) / n), uint32_t(uint64_t(count) * k / n)};
}

}  // namespace duet
