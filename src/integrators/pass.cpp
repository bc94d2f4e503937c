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
           const RenderRequest& request, RenderState& state)
      : scene_(scene),
        integrator_(integrator),
        request_(request),
        state_(state),
        seconds_before_(state.seconds),
        pass_length_(request.pass_seconds) {
    RenderOutlook outlook;
    outlook.film = layout.full;
    outlook.spp = request.budget.spp.value_or(0);
    outlook.threads = request.threads;
    outlook.seconds = request.budget.seconds;
    outlook.target_error = request.budget.target_error;
    outlook.batches = request.budget.target_error ? kErrorBatches : 1;
    integrator.begin(scene, outlook);
    state_.films.reserve(size_t(outlook.batches));
    while (state_.films.size() < size_t(outlook.batches))
      integrator.prepare(state_.films.emplace_back(layout, integrator.channels()));
    prepared_ = seconds() - seconds_before_;
  }

  RenderResult run() {
    if (request_.budget.target_error)
      run_batches();
    else
      run_sequence();
    state_.seconds = seconds();
    return result();
  }

 private:
  double seconds() const {
    const auto now = std::chrono::steady_clock::now();
    return seconds_before_ + std::chrono::duration<double>(now - start_).count();
  }
  bool cancelled() const { return request_.cancel && request_.cancel->load(); }
  /// Trying methods may use up the time, but there is always an image.
  bool out_of_time() const {
    return state_.spp > 0 && request_.budget.seconds && seconds() >= *request_.budget.seconds;
  }

  double seconds_left() const {
    return request_.budget.seconds ? *request_.budget.seconds - seconds()
                                   : std::numeric_limits<double>::infinity();
  }

  /// Adds a range of samples to a film, pass by pass, and counts them: `count` is how many of them
  /// pixels get on average, besides `before` that all films have. Begins after `done` passes of the
  /// range, and keeps that up to date. Ends early if it is cancelled, and a single film also if
  /// time runs out.
  void add_samples(Film& film, const SampleRange& range, int before, int count, uint32_t& done) {
    const double per_sample = double(count) / range.count;
    std::vector<TileSamples> tiles;
    while (done < range.count && !cancelled()) {
      const uint32_t n = uint32_t(pass_length_.next(int(range.count - done), seconds_left()));
      const double start = seconds();
      const SampleRange part = part_of(range, done, n, tiles);
      if (!pass(film, part, before + done * per_sample, n * per_sample)) return;
      pass_length_.took(int(n), seconds() - start);
      done += n;
      state_.spp = before + int(done * per_sample + 1e-6);
      if (state_.films.size() == 1) state_.samples.add({part.first, part.first + n});
      if (request_.keeps_state && request_.after_pass) {
        state_.seconds = seconds();
        request_.after_pass(state_);
      }
      give_snapshot();
      if (state_.films.size() == 1 && out_of_time()) return;
    }
  }

  /// A pass over a film: `before` and `count` are mean numbers of samples of a pixel. Returns
  /// whether nothing of it was left out.
  bool pass(Film& film, const SampleRange& range, double before, double count) {
    // What tells how many samples there are needs the same number everywhere.
    const bool may_stop = integrator_.tiles_may_differ() && !request_.keeps_state;
    std::atomic<bool> whole{true};
    PassControl control;
    control.threads = request_.threads;
    control.cancelled = [&] {
      if (!may_stop || !cancelled()) return false;
      whole = false;
      return true;
    };
    control.report = [&](double fraction) { report(before + count * fraction); };
    integrator_.render_pass(scene_, film, range, control, state_.counters);
    return whole;
  }

  void give_snapshot() {
    if (state_.spp > 0 && request_.wants_snapshot && request_.wants_snapshot())
      request_.snapshot(result());
  }

  /// All samples of a pixel come from one low-discrepancy sequence.
  void run_sequence() {
    const int most = request_.budget.spp.value_or(std::numeric_limits<int>::max());
    const SampleInterval wanted = request_.samples.value_or(SampleInterval{0, uint32_t(most)});
    PartialMeans parts(state_.films[0]);
    parts.set_variance(state_.variance);
    if (state_.spp > 0) note_part(parts);
    is_upper_bound_ = request_.sequence != SampleSequence::independent;
    const std::vector<SampleInterval> missing = state_.samples.missing_from(wanted);
    to_take_ = 0;
    for (const SampleInterval& m : missing) to_take_ += m.count();
    to_take_ += state_.spp;
    for (const SampleInterval& m : missing)
      if (!run_interval(m, std::max(1, int(wanted.count() / kParts)), parts)) return;
    is_complete_ = true;
  }

  void note_part(PartialMeans& parts) {
    parts.add_part(state_.films[0], request_.threads);
    state_.variance = parts.variance();
    if (const auto e = parts.relative_rmse()) relative_rmse_ = e;
  }

  /// Takes samples by parts, from which the error is estimated. False if not all were taken.
  bool run_interval(const SampleInterval& interval, int part, PartialMeans& parts) {
    const bool timed = request_.budget.seconds.has_value();
    if (timed) part = 1;
    for (uint32_t first = interval.first; first < interval.end;) {
      if (cancelled() || out_of_time()) return false;
      const double before = seconds();
      const uint32_t count = std::min(uint32_t(part), interval.end - first);
      uint32_t done = 0;
      add_samples(state_.films[0], {request_.sequence, request_.seed, 0, first, count}, state_.spp,
                  int(count), done);
      if (done < count && cancelled()) return false;
      note_part(parts);
      if (timed) part = next_part(int(done), seconds() - before, int(interval.count()));
      first += done;
    }
    return true;
  }

  /// Several sequences that know nothing of each other, all of the same length: their spread is the
  /// error. Lengths double until the target is met. If that takes a while, the noisier tiles get
  /// more samples.
  void run_batches() {
    const double target = *request_.budget.target_error;
    to_take_ = request_.budget.spp.value_or(std::numeric_limits<int>::max() / 2);
    const BatchRounds& rounds = state_.rounds;
    SampleAllocation allocation(state_.films, rounds.allocated);
    // What is gone on from may be a round under way, or one that is complete.
    const bool is_under_way = rounds.length == 0 || rounds.batch > 0 || rounds.done > 0;
    bool goes_on = is_under_way || plan_round(allocation, target);
    while (goes_on && rounds.spp < to_take_ && !out_of_time()) {
      if (!run_round(allocation)) return;
      goes_on = plan_round(allocation, target);
    }
    is_complete_ = rounds.spp >= to_take_;
  }

  /// Between rounds: whether there is to be another. Sets how many samples it adds.
  bool plan_round(SampleAllocation& allocation, double target) {
    BatchRounds& rounds = state_.rounds;
    relative_rmse_ = batch_relative_rmse(state_.films, request_.threads);
    const bool goes_on = relative_rmse_ ? *relative_rmse_ > target : rounds.length < kBlackSamples;
    if (goes_on) {
      if (!allocation.is_spread() && knows_tiles(rounds.length, target)) allocation.spread();
      rounds.part = next_batch_part(rounds.length, target);
    }
    rounds.allocated = allocation.allocated();
    return goes_on;
  }

  /// Goes on with the round that is under way. False if it is cancelled.
  bool run_round(SampleAllocation& allocation) {
    BatchRounds& rounds = state_.rounds;
    // The budget may not divide evenly among the batches: the first ones get what remains.
    const auto limit = [&](size_t batch) {
      return int(to_take_ / kErrorBatches) + (int64_t(batch) < to_take_ % kErrorBatches);
    };
    int before = rounds.spp;
    for (size_t b = 0; b < size_t(kErrorBatches); ++b) {
      const int count = std::min(rounds.part, limit(b) - rounds.length);
      if (count <= 0) continue;
      SampleRange range{request_.sequence, request_.seed, uint32_t(b)};
      allocation.next(b, uint32_t(count), range);
      if (b >= rounds.batch) {
        if (b > rounds.batch) rounds.done = 0;
        rounds.batch = b;
        add_samples(state_.films[b], range, before, count, rounds.done);
        if (rounds.done < range.count) return false;
      }
      before += count;
      state_.spp = before;
    }
    if (cancelled()) {
      is_complete_ = before >= to_take_;
      return false;
    }
    rounds.spp = before;
    rounds.length += rounds.part;
    rounds.batch = rounds.done = 0;
    return true;
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
    const PixelBounds& crop = state_.films[0].crop();
    p.samples = spp * crop.width() * crop.height();
    p.relative_rmse = relative_rmse_;
    if (request_.budget.spp) p.fraction = spp / double(to_take_);
    if (request_.budget.seconds) p.fraction = std::max(p.fraction, now / *request_.budget.seconds);
    if (request_.budget.target_error && relative_rmse_)
      p.fraction = std::max(
          p.fraction, std::min(1.0, std::pow(*request_.budget.target_error / *relative_rmse_, 2)));
    request_.progress(p);
  }

  RenderResult result() const {
    RenderResult r = develop(state_, request_.threads);
    r.seconds = seconds();
    r.interrupted = cancelled() && !is_complete_;
    r.relative_rmse = relative_rmse_;
    r.rmse_is_upper_bound = is_upper_bound_;
    return r;
  }

  const Scene& scene_;
  Integrator& integrator_;
  const RenderRequest& request_;
  RenderState& state_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  double seconds_before_;  ///< of the renders that this one goes on from
  double prepared_ = 0;    ///< seconds until a method was chosen and ready
  PassLength pass_length_;
  int64_t to_take_ = 0;  ///< samples per pixel when all is done
  bool is_complete_ = false;
  std::optional<double> relative_rmse_;
  bool is_upper_bound_ = false;
  std::mutex report_mutex_;
  double last_report_ = -1;
};

}  // namespace

RenderResult render(const Scene& scene, Integrator& integrator, const FilmLayout& layout,
                    const RenderRequest& request) {
  RenderState state;
  return render(scene, integrator, layout, request, state);
}

RenderResult render(const Scene& scene, Integrator& integrator, const FilmLayout& layout,
                    const RenderRequest& request, RenderState& state) {
  const MotionLease lease(scene.motion.get());
  return Renderer(scene, integrator, layout, request, state).run();
}

RenderResult develop(const RenderState& state, int threads) {
  RenderResult r;
  r.spp = state.spp;
  if (r.spp > 0) r.image = Film::develop(state.films, threads);
  r.counters = state.counters;
  r.seconds = state.seconds;
  return r;
}

}  // namespace duet
