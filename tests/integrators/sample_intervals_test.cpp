#include "integrators/sample_intervals.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <random>
#include <set>

using namespace duet;

TEST_CASE("sample intervals: the same as a set of numbers") {
  std::mt19937 random(3);
  for (int trial = 0; trial < 300; ++trial) {
    SampleIntervals intervals;
    std::set<uint32_t> numbers;
    for (int i = 0; i < 6; ++i) {
      const uint32_t first = random() % 40, end = first + random() % 8;
      bool has = false;
      for (uint32_t k = first; k < end; ++k) has |= numbers.contains(k);
      CHECK(intervals.overlaps({first, end}) == has);
      if (has) continue;
      intervals.add({first, end});
      for (uint32_t k = first; k < end; ++k) numbers.insert(k);
    }
    CHECK(intervals.count() == numbers.size());
    for (size_t i = 1; i < intervals.all().size(); ++i)
      CHECK(intervals.all()[i - 1].end < intervals.all()[i].first);
    const SampleInterval wanted{5, 30};
    std::set<uint32_t> rest;
    for (const SampleInterval& m : intervals.missing_from(wanted))
      for (uint32_t k = m.first; k < m.end; ++k) CHECK(rest.insert(k).second);
    for (uint32_t k = wanted.first; k < wanted.end; ++k)
      CHECK(rest.contains(k) != numbers.contains(k));
    for (const SampleInterval& o : intervals.outside_of(wanted))
      for (uint32_t k = o.first; k < o.end; ++k) {
        CHECK((k < wanted.first || k >= wanted.end));
        CHECK(numbers.erase(k) == 1);
      }
    CHECK(std::all_of(numbers.begin(), numbers.end(),
                      [&](uint32_t k) { return k >= wanted.first && k < wanted.end; }));
    CHECK(std::all_of(rest.begin(), rest.end(), [](uint32_t k) { return k >= 5 && k < 30; }));
  }
}

TEST_CASE("sample intervals: slices are all of the samples, once") {
  for (const uint32_t count : {1u, 7u, 64u, 1u << 30})
    for (const uint32_t n : {1u, 2u, 3u, 7u, 16u}) {
      uint32_t at = 0;
      for (uint32_t k = 1; k <= n; ++k) {
        const SampleInterval slice = slice_of(count, k, n);
        CHECK(slice.first == at);
        CHECK(slice.count() <= count / n + 1);
        at = slice.end;
      }
      CHECK(at == count);
    }
}

TEST_CASE("sample intervals: as text, with the gaps") {
  SampleIntervals intervals;
  intervals.add({4, 8});
  intervals.add({0, 2});
  intervals.add({2, 4});
  intervals.add({12, 13});
  CHECK(to_string(intervals.all()) == "0:8, 12:13");
  CHECK(to_string(intervals.gaps()) == "8:12");
  CHECK(SampleIntervals().gaps().empty());
}
