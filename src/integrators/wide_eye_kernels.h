// The connections of a batch of eye sub-paths: the same formulas as those of one (connection.h), so
// that the results are the same to rounding.
#pragma once

#include "integrators/wide_end_bsdfs.h"
#include "transport/connection_vertex.h"

namespace duet {

/// What connections of the eye vertices of a batch, all at one depth, have in common.
struct WideConnections {
  const WidePaths& paths;
  const WideSubpaths& subpaths;
  const WidePoints& points;
  const WideEnds& eye;
  float share;          ///< TechniqueSet::connection_share
  float camera_scale;   ///< the same over the number of light sub-paths
  float threshold;      ///< of ConnectionRoulette
  uint32_t connection;  ///< ConnectionRoulette::event() of the connection with the light itself
  bool first;           ///< they are what the camera sees
  float scale;          ///< what connections of pairs are to be multiplied by
  float eye_paths = 1;  ///< those that could have gone on to the light vertices of pairs
};

/// How far from the first light vertex those of pairs may be: numbers of their numbers have 32
/// bits.
inline constexpr uint32_t kMostPairVertices =
    0x7fffffff / (sizeof(ConnectionVertex) / sizeof(float));

/// Pairs of an eye vertex with a light vertex.
struct WidePairs {
  BatchArray<int32_t> eye{};     ///< number in the batch
  BatchArray<int32_t> light{};   ///< number in the list of light vertices
  BatchArray<uint32_t> drawn{};  ///< what ConnectionRoulette::event() makes of its `drawn` alone
};

/// Contributions of light samples and their shadow rays: connect_light().
void weigh_light_samples(int n, const WideConnections& c, const WideLightSamples& samples,
                         WideShadowRays& out);
/// Unit directions from the eye vertices of pairs to the light vertices.
void find_directions(int n, const WidePairs& pairs, const WidePoints& points,
                     const ConnectionVertex* light, BatchTriples& out);
/// Contributions of pairs and their shadow rays: weigh_ends().
void weigh_pairs(int n, const WidePairs& pairs, const WideConnections& c,
                 const ConnectionVertex* light, WideShadowRays& out);
/// The same with eye vertices that are glossy: `glossy` has what they make of the directions.
void weigh_glossy_pairs(int n, const WidePairs& pairs, const WideConnections& c,
                        const ConnectionVertex* light, const WideGlossy& glossy,
                        WideShadowRays& out);
/// The same with light vertices that are glossy, and eye vertices of any of these materials.
struct WideGlossyEnds {
  const EndBsdfs &eye, &light;
  const BatchTriples& light_throughput;
};
void weigh_glossy_ends(int n, const WidePairs& pairs, const WideConnections& c,
                       const ConnectionVertex* light, const WideGlossyEnds& ends,
                       WideShadowRays& out);

}  // namespace duet
