#include "integrators/motion_blur.h"

#include <algorithm>
#include <bit>

#include "scene/scene_motion.h"

namespace duet {

namespace {

/// Takes the place of a pixel, but is none.
constexpr uint64_t kTimes = 0x7368757474657221ull;
/// When so many times have been seen, no sample is divided further. A power of two.
constexpr uint32_t kTimesWanted = 128;
/// For fewer pixels of a phase no thread is worth waking.
constexpr uint64_t kPixelsPerThread = 512;

/// The part `i` of `n` of a pass.
PassControl part_of(const PassControl& control, uint32_t i, uint32_t n) {
  PassControl part = control;
  part.report = [&control, i, n](double fraction) {
    control.report((double(i) + fraction) / double(n));
  };
  return part;
}

}  // namespace

double time_of_sample(const SampleRange& range, uint32_t sample, uint32_t phase) {
  Sampler sampler(range.sequence, range.seed, range.scramble, kTimes + phase);
  sampler.start_sample(sample);
  // The first dimensions take the points in the order in which pixels do: one number of a pixel
  // would always come with the same time.
  sampler.start_dimension(kSobolDimensions);
  return double(sampler.next_1d());
}

uint32_t phases_of_sample(uint32_t sample, uint32_t most) {
  // Whenever their number doubles, samples see half of kTimesWanted more times.
  const uint32_t samples = std::bit_ceil(std::min(sample, kTimesWanted - 1) + 1);
  return std::min(most, kTimesWanted / samples);
}

void MotionPhases::start(const Scene& scene, Point2i film, uint32_t most,
                         const SampleRange& samples) {
  // Each thing that a pose moves, sorts or surveys takes about as long as a sample of a pixel.
  const double pixels = double(film.x) * film.y;
  const auto moved = double(scene.shapes.size() + scene.instances.size() + scene.lights.size() +
                            scene.motion->moved_triangles());
  // No phase may be without pixels.
  if (pixels < double(PixelPhases::kRun * PixelPhases::kMost)) most = 1;
  while (most > 1 && most * moved > pixels) most /= 2;
  most_ = most;
  // Who has one phase has all pixels.
  if (most > 1) pixels_.start(film, hash_combine(samples.seed, samples.scramble));
}

void for_each_sample(const SampleRange& samples, const PassControl& control,
                     const RangeWork& work) {
  std::vector<TileSamples> tiles;
  for (uint32_t i = 0; i < samples.count && !control.cancelled(); ++i)
    work(part_of(samples, i, 1, tiles), part_of(control, i, samples.count));
}

void for_each_pose(const Scene& scene, const MotionPhases& phases, const SampleRange& samples,
                   const PassControl& control, const RangeWork& work) {
  for_each_sample(samples, control, [&](const SampleRange& one, const PassControl& sample) {
    const uint32_t count = phases.count(one.first);
    for (uint32_t k = 0; k < count; ++k) {
      const PixelPhase phase = phases.phase(one.first, k);
      SampleRange some = one;
      PassControl part = part_of(sample, k, count);
      if (count > 1) {
        some.phase = &phase;
        part.cancelled = [] { return false; };
        part.is_finished = true;
        part.threads = std::clamp(int(phase.pixels() / kPixelsPerThread), 1, sample.threads);
      }
      scene.motion->pose(time_of_sample(samples, one.first, k));
      work(some, part);
    }
  });
}

}  // namespace duet
