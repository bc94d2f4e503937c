// The stages of a batch of eye sub-paths that are loops over numbers: the same formulas as those of
// one sub-path (subpath.h, connection.h, mis.h), so that the results are the same to rounding.
#pragma once

#include "integrators/wide_glossy.h"
#include "transport/diffuse_vertex.h"

namespace duet {

/// What eye sub-paths carry beside what paths do. WidePaths::bsdf_pdf is Subpath::forward, negative
/// after delta lobes; WidePaths::eta is not used.
struct WideSubpaths {
  BatchArray<float> vcm, vc, vm;  ///< Partials, on leaving a vertex or once arrived at the next
  BatchArray<float> carried;      ///< Subpath::carried
};

/// The eye vertices of a batch as connections see them.
struct WideEyeVertices {
  BatchTriples flux;              ///< throughput times reflectance, of diffuse surfaces
  BatchTriples lit;               ///< their shading normal on the lit side, or zero
  BatchArray<float> reverse;      ///< density of going back from where light comes in
  BatchArray<uint32_t> roulette;  ///< seeds of ConnectionRoulette
  /// 1 if photons may be merged for what is scattered at the vertex: PathVertex::merges().
  BatchArray<int32_t> merges;
  /// TechniqueSet::merge_term(), or zero where the pixel does not merge.
  BatchArray<float> merge_term;
  BatchArray<int32_t> unmerged;  ///< 1 in pixels that do not merge if the method merges in others
  BatchArray<float> sum;         ///< BalanceWeights::connections() of the sums there
};

/// What connections of the eye vertices of a batch, all at one depth, have in common.
struct WideConnections {
  const WidePaths& paths;
  const WideSubpaths& subpaths;
  const WidePoints& points;
  const WideEyeVertices& eye;
  float share;          ///< TechniqueSet::connection_share
  float threshold;      ///< of ConnectionRoulette
  uint32_t connection;  ///< ConnectionRoulette::event() of the connection with the light itself
};

/// Where sub-paths go on from.
struct WideDepartures {
  const TechniqueSet& set;
  const WideEyeVertices& eye;
  const WidePoints& points;
};

/// Pairs of an eye vertex of one material with a diffuse light vertex.
struct WidePairs {
  BatchArray<int32_t> eye;    ///< number in the batch
  BatchArray<int32_t> light;  ///< number in the list of light vertices
};

/// arrive() at the points of a batch. Sub-paths that arrive along the surface carry nothing on.
void arrive(int n, const HitBatch& hits, const WidePoints& points, bool connections,
            WidePaths& paths, WideSubpaths& subpaths);
/// Surfaces that reflect, diffuse or glossy, as ends of connections; `reverse` is that of diffuse
/// ones.
void make_ends(int n, const WidePaths& paths, const WideSubpaths& subpaths,
               const WidePoints& points, WideEyeVertices& out);
/// Contributions of light samples and their shadow rays: connect_light().
void weigh_light_samples(int n, const WideConnections& c, const WideLightSamples& samples,
                         WideShadowRays& out);
/// Unit directions from the eye vertices of pairs to the light vertices.
void find_directions(int n, const WidePairs& pairs, const WidePoints& points,
                     const DiffuseVertex* light, BatchTriples& out);
/// Contributions of pairs and their shadow rays: weigh_ends().
void weigh_pairs(int n, const WidePairs& pairs, const WideConnections& c,
                 const DiffuseVertex* light, WideShadowRays& out);
/// The same with eye vertices that are glossy: `glossy` has what they make of the directions.
void weigh_glossy_pairs(int n, const WidePairs& pairs, const WideConnections& c,
                        const DiffuseVertex* light, const WideGlossy& glossy, WideShadowRays& out);
/// The next rays and the sums that go with them: leave(). For delta lobes the reverse density of
/// `from` is the factor of leave_specular().
void go_on(int n, bool roulette, const WideDepartures& from, WideScattering& scattering,
           WidePaths& paths, WideSubpaths& subpaths);

}  // namespace duet
