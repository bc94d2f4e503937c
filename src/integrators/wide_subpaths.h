// Batches of sub-paths from vertex to vertex, in loops over numbers: the same formulas as those of
// one sub-path (subpath.h, mis.h), so that the results are the same to rounding.
#pragma once

#include <optional>

#include "integrators/wide_glossy.h"
#include "transport/mis.h"
#include "transport/roulette.h"

namespace duet {

/// What sub-paths carry beside what paths do. WidePaths::bsdf_pdf is Subpath::forward, negative
/// after delta lobes; WidePaths::eta is not used.
struct WideSubpaths {
  BatchArray<float> vcm, vc, vm;  ///< Partials, on leaving a vertex or once arrived at the next
  BatchArray<float> carried;      ///< Subpath::carried
};

/// The vertices of a batch as ends of connections.
struct WideEnds {
  BatchTriples flux;              ///< throughput times reflectance, of diffuse surfaces
  BatchTriples lit;               ///< their shading normal on the lit side, or zero
  BatchArray<float> reverse;      ///< density of going back from the other end
  BatchArray<uint32_t> roulette;  ///< seeds of ConnectionRoulette
  /// 1 if photons may be merged for what is scattered at the vertex: PathVertex::merges().
  BatchArray<int32_t> merges;
  /// TechniqueSet::merge_term(), or zero where the pixel does not merge.
  BatchArray<float> merge_term;
  BatchArray<int32_t> unmerged;  ///< 1 in pixels that do not merge if the method merges in others
  BatchArray<float> sum;         ///< BalanceWeights::connections() of the sums there
};

/// Where sub-paths go on from.
struct WideDepartures {
  const TechniqueSet& set;
  const WideEnds& ends;
  const WidePoints& points;
  std::optional<Roulette> roulette;
};

/// beyond_end(); `merge_term` is zero where the end does not merge.
[[gnu::always_inline]] inline float beyond(float arrival, float merge_term, float vcm,
                                           float reverse, float sum) {
  return arrival * (merge_term + vcm + reverse * sum);
}

/// arrive() at the points of a batch. Sub-paths that arrive along the surface carry nothing on.
void arrive(int n, const HitBatch& hits, const WidePoints& points, bool connections,
            WidePaths& paths, WideSubpaths& subpaths);
/// Surfaces that reflect, diffuse or glossy, as ends of connections; `reverse` is that of diffuse
/// ones.
void make_ends(int n, const WidePaths& paths, const WideSubpaths& subpaths,
               const WidePoints& points, WideEnds& out);
/// The next rays and the sums that go with them: leave(). For delta lobes the reverse density of
/// `from` is the factor of leave_specular().
void go_on(int n, const WideDepartures& from, WideScattering& scattering, WidePaths& paths,
           WideSubpaths& subpaths);

}  // namespace duet
