#include "evaluate/chart/renderers.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "base/system/process.h"

namespace duet {

namespace {

/// Points are at least this factor of time apart.
constexpr double kPointDistance = 1.41421356;
/// Points earlier than this share of the budget are not waited for, but taken with every slice.
constexpr double kFirstShare = 1.0 / 1024;

}  // namespace

void ChartRenderer::record(double seconds, double cpu_seconds, int spp, Image image) {
  const ReferenceErrors e = reference_.errors(image);
  line.points.push_back({seconds, cpu_seconds, spp, e.mse, e.relmse, e.trimmed, e.firefly,
                         e.tile_sums, e.tile_pixels});
  line.image = std::move(image);
}

OwnRenderer::OwnRenderer(const ChartRender& render, std::unique_ptr<Integrator> integrator,
                         const NoisyReference& reference, double budget)
    : ChartRenderer(reference, budget),
      render_(render),
      integrator_(std::move(integrator)),
      film_(render.layout, integrator_->channels()) {
  const auto start = std::chrono::steady_clock::now();
  const double cpu = process_cpu_seconds();
  integrator_->begin(*render.scene, {render.layout.full, 64, render.threads});
  integrator_->prepare(film_);
  cpu_seconds_ = process_cpu_seconds() - cpu;
  seconds_ = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  line.bias = integrator_->bias();
}

bool OwnRenderer::finished() const {
  // The next sample should end within the budget rather than beyond it.
  return spp_ > 0 && seconds_ + 0.5 * seconds_ / spp_ >= budget_;
}

void OwnRenderer::slice(double wanted) {
  int count = 1;
  if (spp_ > 0) {
    const double until_point = std::max(next_point_ - seconds_, 0.0);
    const double per_sample = std::max(seconds_ / spp_, 1e-9);
    const double samples = std::min({wanted, until_point, budget_ - seconds_}) / per_sample;
    count = int(std::clamp(std::round(samples), 1.0, double(2 * spp_)));
  }
  const auto start = std::chrono::steady_clock::now();
  const double cpu = process_cpu_seconds();
  PassControl control;
  control.threads = render_.threads;
  control.cancelled = [this] { return render_.cancel->load(); };
  const SampleRange range{SampleSequence::sobol, render_.seed, 0, uint32_t(spp_), uint32_t(count)};
  integrator_->render_pass(*render_.scene, film_, range, control, counters_);
  if (render_.cancel->load()) return;  // what the film has now is not what a point says
  cpu_seconds_ += process_cpu_seconds() - cpu;
  seconds_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  spp_ += count;
  if (seconds_ < next_point_) return;
  add_point();
  next_point_ = std::max(budget_ * kFirstShare, kPointDistance * seconds_);
}

void OwnRenderer::add_point() {
  record(seconds_, cpu_seconds_, spp_, film_.develop());
  recorded_spp_ = spp_;
}

void OwnRenderer::finish() {
  if (spp_ == recorded_spp_ || render_.cancel->load()) return;
  // A point that is due only because time is up replaces one that it nearly repeats.
  if (line.points.size() > 1 && line.points.back().seconds * 1.15 > seconds_)
    line.points.pop_back();
  add_point();
}

}  // namespace duet
