// Integrator interface: how a method of light transport fills a film.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "image/film.h"
#include "math/pixel_order.h"
#include "math/sampler.h"
#include "scene/scene.h"
#include "transport/counters.h"

namespace duet {

/// Samples first … first + count − 1 of the pixels of a tile.
struct TileSamples {
  uint32_t first = 0, count = 0;
};

/// Samples first … first + count − 1 of every pixel, of one random sequence.
struct SampleRange {
  SampleSequence sequence = SampleSequence::sobol;
  uint64_t seed = 0;
  uint32_t scramble = 0;  ///< number of the batch; batches are independent
  uint32_t first = 0, count = 0;
  /// If not empty, what each tile of the film gets instead; `count` is the greatest of theirs.
  /// Sub-paths that start at lights are not part of a tile and follow the range.
  std::span<const TileSamples> tiles = {};
  /// If not null, the pixels that are meant; light sub-paths are shared out among the phases.
  const PixelPhase* phase = nullptr;
};

/// The samples `done` … `done` + `count` − 1 of a range. `tiles` holds those of its tiles, if the
/// range has any.
SampleRange part_of(const SampleRange& range, uint32_t done, uint32_t count,
                    std::vector<TileSamples>& tiles);

/// Those of a range that the `tile`-th tile of a film gets.
inline TileSamples samples_of_tile(const SampleRange& range, size_t tile) {
  return range.tiles.empty() ? TileSamples{range.first, range.count} : range.tiles[tile];
}

/// Whether a range has a pixel, y · width + x of the full image.
inline bool has_pixel(const SampleRange& range, uint64_t pixel) {
  return !range.phase || range.phase->has(pixel);
}

/// How a pass is to be run.
struct PassControl {
  int threads = 1;
  /// Whether to stop as soon as the film is fit to be developed.
  std::function<bool()> cancelled = [] { return false; };
  /// Whether it is finished in any case: cancelled() is false then.
  bool is_finished = false;
  /// Takes the share of the pass that is done, from any thread.
  std::function<void(double)> report = [](double) {};
};

/// What is known of a render before its first pass. The first limit that is reached ends it.
struct RenderOutlook {
  Point2i film;  ///< size of the whole image
  int spp = 64;  ///< samples that a pixel gets at most; 0 for any number
  int threads = 1;
  std::optional<double> seconds = {};       ///< RenderBudget::seconds
  std::optional<double> target_error = {};  ///< RenderBudget::target_error
  int batches = 1;  ///< independent images of which it is the mean, each with its share of samples
};

/// What a method that chooses another has chosen, and why.
struct MethodDecision {
  std::string method, parameters;
  std::string reason;                     ///< one line
  std::vector<std::string> candidates;    ///< what each method promised, a line each
  std::vector<uint8_t> merge_parts = {};  ///< BidirectionalIntegratorDescription::merge_parts
  std::string bias = {};                  ///< why the mean of many images is wrong, or ""
};

class MotionPhases;

/// A method of light transport, for any number of images of one scene and one size of film. An
/// image does not depend on those that were rendered before it.
class Integrator {
 public:
  virtual ~Integrator() = default;
  /// Names of the film channels that render_pass() fills, in order.
  virtual std::vector<std::string> channels() const = 0;
  /// To be called with the scene that is to be rendered, before prepare(); for a second time it
  /// does nothing. What happens here is not part of the image. What moves in the scene is where it
  /// is when half the time that the shutter is open is over.
  void begin(const Scene& scene, const RenderOutlook& outlook);
  /// After begin(): what was chosen, or null if there is no choice.
  virtual const MethodDecision* decision() const { return nullptr; }
  /// For people: why even the mean of many images is wrong, if it is.
  virtual std::string bias() const { return ""; }
  /// Whether the image is blurred, less with every sample, so that its noise is not all of its
  /// error.
  virtual bool blurs() const { return false; }
  /// Whether the layers of the image tell how noisy it is: not where light sub-paths add to pixels
  /// that are not theirs. To be asked after begin().
  virtual bool layers_tell_noise() const { return true; }
  /// Of a scene that moves, into how many parts the pixels may be divided that see a sample at
  /// times of their own: a power of two. To be asked after begin().
  virtual uint32_t most_phases(Point2i) const { return PixelPhases::kMost; }
  /// Whether tiles may have different numbers of samples.
  virtual bool tiles_may_differ() const { return true; }
  /// What the method keeps in memory besides the film, in bytes, estimated before it is known. To
  /// be asked after begin().
  virtual double memory_bytes(const FilmLayout&) const { return 0; }
  /// Called once for each film, before its first pass.
  virtual void prepare(Film&) const {}
  /// Which of the channels are no colours but numbers that need all digits of 32-bit floats, such
  /// as positions and indices.
  virtual std::vector<std::string> data_channels() const { return {}; }
  /// Adds samples to every pixel of the film. The sums of the film are the same bit for bit however
  /// its samples are divided into passes. A pass that is cancelled leaves a film whose mean is
  /// still right. If the scene moves, it is posed for each phase of each sample (motion_blur.h), so
  /// passes over it come one after another: this and begin() take a MotionLease.
  void render_pass(const Scene& scene, Film& film, const SampleRange& samples,
                   const PassControl& control, RenderCounters& counters);

 protected:
  /// What begin() and render_pass() do with a scene that stands still, for as long as they last.
  virtual void choose(const Scene&, const RenderOutlook&) {}
  virtual void render_samples(const Scene& scene, Film& film, const SampleRange& samples,
                              const PassControl& control, RenderCounters& counters) = 0;

 private:
  /// Of a scene that moves; shared only because the type is not complete here.
  std::shared_ptr<MotionPhases> phases_;
};

}  // namespace duet
