// Photons merged with the points of a batch of eye sub-paths: the same formulas as those of one
// point (connection.h), so that the results are the same to rounding.
#pragma once

#include "integrators/wide_end_bsdfs.h"
#include "transport/light_vertex.h"

namespace duet {

/// Photons, each near one of the points.
struct WidePhotons {
  BatchArray<int32_t> point;  ///< number in the batch
  BatchTriples arriving;
  BatchArray<float> vcm, vc, vm;  ///< LightVertex::partials_below()
  BatchArray<uint32_t> u, v;      ///< LightVertex::wo
  BatchArray<int32_t> depth;

  /// The photon near point `number`, whose sums it has met with.
  void set(int k, int number, const LightVertex& photon, const Partials& p) {
    point[k] = number;
    arriving.set(k, photon.arriving.r, photon.arriving.g, photon.arriving.b);
    vcm[k] = p.vcm, vc[k] = p.vc, vm[k] = p.vm;
    u[k] = photon.wo[0], v[k] = photon.wo[1];
    depth[k] = photon.depth;
  }
};

/// What merges at the points of a batch have in common.
struct WideMerges {
  const WidePaths& paths;
  const WideSubpaths& subpaths;
  const WidePoints& points;
  const WideEnds& ends;
  const BatchArray<float>& kernel;  ///< weights of the photons, by point
  float connection_term;            ///< TechniqueSet::connection_term()
  bool partly_merged;               ///< TechniqueSet::partly_merged
  int most;                         ///< segments that a photon's sub-path may have
};

/// What `n` photons contribute at diffuse points: connect_merge(). `merged` is 1 for those that do.
void merge_photons(int n, const WidePhotons& photons, const WideMerges& m, BatchTriples& out,
                   BatchArray<int32_t>& merged);
/// The same at glossy points: `bsdfs` has what they make of the photons' directions.
void merge_glossy_photons(int n, const WidePhotons& photons, const EndBsdfs& bsdfs,
                          const WideMerges& m, BatchTriples& out, BatchArray<int32_t>& merged);

}  // namespace duet
