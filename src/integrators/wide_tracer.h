// Path tracing of many pixels at once, stage by stage.
#pragma once

#include <memory>

#include "integrators/wide_path_groups.h"
#include "integrators/wide_stages.h"
#include "integrators/wide_walk.h"
#include "scene/description_integrators.h"

namespace duet {

/// Traces paths in the same way as PathIntegrator traces one path: with the same random numbers
/// every path is the same bit for bit, unless it meets two surfaces that are equally near or, by
/// rounding, the edge of one. Usual rough plastics and conductors are scattered in loops, too, and
/// what lies below masks, bump and normal maps; below maps directions are chosen in another frame
/// around the same normal, so that paths differ from there on.
/// In groups of pixels, which PathIntegrator does not have one by one, paths are the same up to
/// their second vertices.
class WideTracer final : public WideWalk, private WideStages {
 public:
  WideTracer(const WideScene& scene, const PathIntegratorDescription& options)
      : WideStages(scene, options, Transport::radiance) {
    if (options.pixel_group > 1)
      groups_ =
          std::make_unique<WidePathGroups>(scene, options.strict_normals, options.pixel_group);
  }

  WidePaths& paths() override { return paths_; }
  void enter(std::span<const uint64_t> pixels) override { pixel_count_ = int(pixels.size()); }
  void trace(int n, const BatchSampler& sampler, WideSamples& samples,
             RenderCounters& counters) override;

 private:
  /// Where contributions go: to a pixel, or to the second vertex that its group shares.
  struct Sums {
    WideSamples& samples;
    WidePathGroups* groups;
    void add(int id, const Spectrum& s) {
      if (groups && groups->shares(id))
        groups->add(id, s, samples);
      else
        samples.add(id, s);
    }
  };

  void share_vertices(int n, int depth);
  /// Adds what those find that have left the scene; the rest is left in front.
  int end_outside(int n, Sums& sums);
  void add_emission(Sums& sums) const;
  /// The values for the light samples, and the next directions, at points that the code for one
  /// path has to look at.
  void scatter_one_by_one();
  void add_light(int n, Sums& sums, RenderCounters& counters);
  int keep_alive(int n);

  std::optional<PdfW> bsdf_pdf(int i) const {
    return paths_.bsdf_pdf[i] < 0 ? std::nullopt : std::optional(PdfW{paths_.bsdf_pdf[i]});
  }

  std::unique_ptr<WidePathGroups> groups_;  ///< null if each pixel has its own paths alone
  int pixel_count_ = 0;
};

}  // namespace duet
