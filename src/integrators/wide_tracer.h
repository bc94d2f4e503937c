// Path tracing of many pixels at once, stage by stage.
#pragma once

#include "integrators/wide_stages.h"
#include "integrators/wide_walk.h"

namespace duet {

/// Traces paths in the same way as PathIntegrator traces one path: with the same random numbers
/// every path is the same bit for bit, unless it meets two surfaces that are equally near or, by
/// rounding, the edge of one. Usual rough plastics and conductors are scattered in loops, too.
class WideTracer final : public WideWalk, private WideStages {
 public:
  WideTracer(const WideScene& scene, const PathLimits& limits)
      : WideStages(scene, limits, Transport::radiance) {}

  WidePaths& paths() override { return paths_; }
  void trace(int n, const BatchSampler& sampler, WideSamples& samples,
             RenderCounters& counters) override;

 private:
  /// Adds what those find that have left the scene; the rest is left in front.
  int end_outside(int n, WideSamples& samples);
  void add_emission(WideSamples& samples) const;
  /// The values for the light samples, and the next directions, at points that the code for one
  /// path has to look at.
  void scatter_one_by_one();
  void add_light(int n, WideSamples& samples, RenderCounters& counters);
  int keep_alive(int n);

  std::optional<PdfW> bsdf_pdf(int i) const {
    return paths_.bsdf_pdf[i] < 0 ? std::nullopt : std::optional(PdfW{paths_.bsdf_pdf[i]});
  }
};

}  // namespace duet
