#include "integrators/pass.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <limits>
#include <mutex>

#include "integrators/error_estimate.h"
#include "integrators/pass_length.h"
#include "integrators/sample_allocation.h"
#include "scene/scene_motion.h"

namespace duet {

namespace {

/// Parts into which a known number of samples is divided for the error bound.
constexpr int kParts = 8;
/// Samples of each batch after which an image that is still black is taken to be so: there is no
/// error relative to nothing.
constexpr int kBlackSamples = 256;
/// Samples of each batch after which the noise of tiles may be known, and is known.
constexpr int kShortPilot = 4, kLongPilot = 32;
/// Between these two, samples yet to come, as a multiple of those that there are, for which it is
/// not worth waiting.
constexpr double kFewRemaining = 8;

class Renderer {
 public:
  Renderer(const Scene& scene, Integrator& integrator, const FilmLayout& layout,
           const RenderRequest& request)
      : scene_(scene),
        integrator_(integrator),
        request_(request),
        pass_length_(request.pass_seconds) {
    RenderOutlook outlook;
    outlook.film = layout.full;
    outlook.spp = request.budget.spp.value_or(0);
    outlook.threads = request.threads;
    outlook.seconds = request.budget.seconds;
    outlook.target_error = request.budget.target_error;
    outlook.batches = request.budget.target_error ? kErrorBatches : 1;
    integrator.begin(scene, outlook);
    films_.reserve(size_t(outlook.batches));
    for (int i = 0; i < outlook.batches; ++i)
      integrator.prepare(films_.emplace_back(layout, integrator.channels()));
    prepared_ = seconds();
  }

  RenderResult run() {
    if (request_.budget.target_error)
      run_batches();
    else
      run_sequence();
    return result();
  }

 private:
  double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }
  bool cancelled() const { return request_.cancel && request_.cancel->load(); }
  /// Trying methods may use up the time, but there is always an image.
  bool out_of_time() const {
    return spp_ > 0 && request_.budget.seconds && seconds() >= *request_.budget.seconds;
  }

  double seconds_left() const {
    return request_.budget.seconds ? *request_.budget.seconds - seconds()
                                   : std::numeric_limits<double>::infinity();
  }

  /// Adds a range of samples to a film, pass by pass, and counts them: `count` is how many of them
  /// pixels get on average. Ends early if it is cancelled, and a single film also if time runs out.
  void add_samples(Film& film, const SampleRange& range, int count) {
    const int before = spp_;
    const double per_sample = double(count) / range.count;
    std::vector<TileSamples> tiles;
    for (uint32_t done = 0; done < range.count && !cancelled();) {
      const uint32_t n = uint32_t(pass_length_.next(int(range.count - done), seconds_left()));
      const double start = seconds();
      if (!pass(film, part_of(range, done, n, tiles), before + done * per_sample, n * per_sample))
        return;
      pass_length_.took(int(n), seconds() - start);
      done += n;
      spp_ = before + int(done * per_sample + 1e-6);
      give_snapshot();
      if (films_.size() == 1 && out_of_time()) return;
    }
  }

  /// A pass over a film: `before` and `count` are mean numbers of samples of a pixel. Returns
  /// whether nothing of it was left out.
  bool pass(Film& film, const SampleRange& range, double before, double count) {
    // What tells how many samples there are needs the same number everywhere.
    const bool may_stop = integrator_.tiles_may_differ();
    std::atomic<bool> whole{true};
    PassControl control;
    control.threads = request_.threads;
    control.cancelled = [&] {
      if (!may_stop || !cancelled()) return false;
      whole = false;
      return true;
    };
    control.report = [&](double fraction) { report(before + count * fraction); };
    integrator_.render_pass(scene_, film, range, control, counters_);
    return whole;
  }

  void give_snapshot() {
    if (spp_ > 0 && request_.wants_snapshot && request_.wants_snapshot())
      request_.snapshot(result());
  }

  /// All samples of a pixel come from one low-discrepancy sequence.
  void run_sequence() {
    Film& film = films_[0];
    PartialMeans parts(film);
    is_upper_bound_ = request_.sequence != SampleSequence::independent;
    const bool timed = request_.budget.seconds.has_value();
    const int total = request_.budget.spp.value_or(std::numeric_limits<int>::max());
    int part = std::max(1, total / kParts);
    if (timed) part = 1;
    while (spp_ < total && !cancelled() && !out_of_time()) {
      const double before = seconds();
      const int first = spp_, count = std::min(part, total - spp_);
      add_samples(film, {request_.sequence, request_.seed, 0, uint32_t(first), uint32_t(count)},
                  count);
      if (cancelled()) break;
      parts.add_part(film);
      if (const auto e = parts.relative_rmse()) relative_rmse_ = e;
      if (timed) part = next_part(spp_ - first, seconds() - before, total);
    }
  }

  /// Several sequences that know nothing of each other, all of the same length: their spread is the
  /// error. Lengths double until the target is met. If that takes a while, the noisier tiles get
  /// more samples.
  void run_batches() {
    const double target = *request_.budget.target_error;
    const int total = request_.budget.spp.value_or(std::numeric_limits<int>::max() / 2);
    int length = 0, part = 1;
    SampleAllocation allocation(films_);
    // The budget may not divide evenly among the batches: the first ones get what remains.
    const auto limit = [&](int batch) {
      return total / kErrorBatches + (batch < total % kErrorBatches);
    };
    while (spp_ < total && !cancelled() && !out_of_time()) {
      for (int b = 0; b < kErrorBatches && !cancelled(); ++b) {
        const int count = std::min(part, limit(b) - length);
        if (count <= 0) continue;
        SampleRange range{request_.sequence, request_.seed, uint32_t(b)};
        allocation.next(size_t(b), uint32_t(count), range);
        add_samples(films_[b], range, count);
      }
      if (cancelled()) break;
      length += part;
      relative_rmse_ = batch_relative_rmse(films_);
      if (relative_rmse_ ? *relative_rmse_ <= target : length >= kBlackSamples) break;
      if (!allocation.is_spread() && knows_tiles(length, target)) allocation.spread();
      part = next_batch_part(length, target);
    }
  }

  /// Whether batches of this length tell the noise of tiles as well as need be.
  bool knows_tiles(int length, double target) const {
    if (!integrator_.tiles_may_differ() || !relative_rmse_ || length < kShortPilot) return false;
    return length >= kLongPilot || std::pow(*relative_rmse_ / target, 2) < kFewRemaining;
  }

  /// By how much to lengthen the batches: towards the length that should meet the target, but at
  /// most doubling, and within the time that is left.
  int next_batch_part(int length, double target) const {
    double needed = double(length);
    if (relative_rmse_) needed *= std::pow(*relative_rmse_ / target, 2) - 1;
    int part = int(std::clamp(needed, 1.0, double(length)));
    if (request_.budget.seconds) {
      const double left = *request_.budget.seconds - seconds();
      const double per_sample = (seconds() - prepared_) / (double(length) * kErrorBatches);
      part = int(std::clamp(left / (per_sample * kErrorBatches), 1.0, double(part)));
    }
    return part;
  }

  /// Parts of a timed render grow until they last about a sixteenth of the budget, and end within
  /// it.
  int next_part(int count, double took, int total) const {
    const double budget = *request_.budget.seconds, left = budget - seconds();
    const double per_sample = std::max(took / count, 1e-9);
    const double wanted =
        std::min({double(2 * count), budget / 16 / per_sample, left / per_sample});
    return int(std::clamp(wanted, 1.0, double(total)));
  }

  /// `spp`: samples that pixels have on average.
  void report(double spp) {
    if (!request_.progress) return;
    const std::unique_lock lock(report_mutex_, std::try_to_lock);
    if (!lock) return;
    const double now = seconds();
    if (now - last_report_ < 0.1) return;
    last_report_ = now;
    RenderProgress p;
    p.seconds = now;
    p.spp = spp;
    const Point2i size = {films_[0].crop().width(), films_[0].crop().height()};
    p.samples = spp * size.x * size.y;
    p.relative_rmse = relative_rmse_;
    if (request_.budget.spp) p.fraction = spp / *request_.budget.spp;
    if (request_.budget.seconds) p.fraction = std::max(p.fraction, now / *request_.budget.seconds);
    if (request_.budget.target_error && relative_rmse_)
      p.fraction = std::max(
          p.fraction, std::min(1.0, std::pow(*request_.budget.target_error / *relative_rmse_, 2)));
    request_.progress(p);
  }

  RenderResult result() const {
    RenderResult r;
    if (spp_ > 0) {
      r.image = Film::develop(films_);
      integrator_.finish(r.image, spp_);
    }
    r.counters = counters_;
    r.spp = spp_;
    r.seconds = seconds();
    r.interrupted = cancelled() && !(request_.budget.spp && spp_ >= *request_.budget.spp);
    r.relative_rmse = relative_rmse_;
    r.rmse_is_upper_bound = is_upper_bound_;
    return r;
  }

  const Scene& scene_;
  Integrator& integrator_;
  const RenderRequest& request_;
  std::vector<Film> films_;
  RenderCounters counters_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  double prepared_ = 0;  ///< seconds until a method was chosen and ready
  PassLength pass_length_;
  int spp_ = 0;  ///< samples of passes that are complete
  std::optional<double> relative_rmse_;
  bool is_upper_bound_ = false;
  std::mutex report_mutex_;
  double last_report_ = -1;
};

}  // namespace

RenderResult render(const Scene& scene, Integrator& integrator, const FilmLayout& layout,
                    const RenderRequest& request) {
  const MotionLease lease(scene.motion.get());
  return Renderer(scene, integrator, layout, request).run();
}

}  // namespace duet
