// How a scene that moves is rendered as the mean over its poses.
//
// Each sample per pixel (or iteration) is divided into phases, which have some of the pixels each,
// and each phase sees the scene as it is at one time. The times of a phase are points of a sequence
// of their own, each of them even over the time that the shutter is open, so the expected image is
// the mean over that time whatever the method, if only the method is right for scenes that stand
// still.
#pragma once

#include "integrators/integrator.h"

namespace duet {

/// When a phase of a sample is seen, as a share of the time from the opening of the shutter to its
/// closing. It depends on the seed, the batch and the two numbers alone.
double time_of_sample(const SampleRange& range, uint32_t sample, uint32_t phase);

/// Phases of a sample of which there may be `most`, a power of two. The more samples there are
/// before it, the fewer it needs: together they have seen enough times.
uint32_t phases_of_sample(uint32_t sample, uint32_t most);

/// How samples of a scene that moves are divided.
class MotionPhases {
 public:
  /// For samples of one random sequence by a method that allows so many phases. There are fewer
  /// where posing the scene takes long for the number of pixels. Costs nothing if that is what was
  /// done before.
  void start(const Scene& scene, Point2i film, uint32_t most, const SampleRange& samples);

  /// One of the phases of a sample.
  PixelPhase phase(uint32_t sample, uint32_t index) const {
    return {&pixels_, index, count(sample)};
  }
  uint32_t count(uint32_t sample) const { return phases_of_sample(sample, most_); }

 private:
  PixelPhases pixels_;
  uint32_t most_ = 1;
};

using RangeWork = std::function<void(const SampleRange&, const PassControl&)>;

/// Calls `work` for each sample of a range, with a control for this part of the pass, until it is
/// cancelled.
void for_each_sample(const SampleRange& samples, const PassControl& control, const RangeWork& work);

/// The same for each phase of each sample, for which the scene has been posed. Samples that have
/// begun are finished if they have several. The scene moves.
void for_each_pose(const Scene& scene, const MotionPhases& phases, const SampleRange& samples,
                   const PassControl& control, const RangeWork& work);

}  // namespace duet
