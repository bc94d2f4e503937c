#include "integrators/motion_blur.h"

namespace duet {

namespace {

/// Takes the place of a pixel, but is none.
constexpr uint64_t kTimes = 0x7368757474657221ull;

}  // namespace

double time_of_sample(const SampleRange& range, uint32_t sample) {
  Sampler sampler(range.sequence, range.seed, range.scramble, kTimes);
  sampler.start_sample(sample);
  // The first dimensions take the points in the order in which pixels do: one number of a pixel
  // would always come with the same time.
  sampler.start_dimension(kSobolDimensions);
  return double(sampler.next_1d());
}

void for_each_sample(const SampleRange& samples, const PassControl& control,
                     const std::function<void(const SampleRange&, const PassControl&)>& work) {
  std::vector<TileSamples> tiles;
  for (uint32_t i = 0; i < samples.count && !control.cancelled(); ++i) {
    PassControl part = control;
    part.report = [&](double fraction) {
      control.report((double(i) + fraction) / double(samples.count));
    };
    work(part_of(samples, i, 1, tiles), part);
  }
}

}  // namespace duet
