// Multiple importance sampling over all techniques that could have made a path, by sums that a
// sub-path carries along: each connection costs a handful of operations, however long the path is.
//
// Notation (docs/mis.md): a path x_0 (on a light) … x_k (on the lens) of k segments is made by
// technique (s, t) from a light sub-path of s vertices and an eye sub-path of t = k + 1 − s. A
// weight is n_i p_i / Σ n_j p_j, the balance heuristic with n samples of density p each. Source:
// Veach 1997, section 10.2; Georgiev, "Implementing Vertex Connection and Merging", 2012, equations
// 31 to 50, generalised to several samples per technique (docs/mis.md).
#pragma once

#include <cmath>

#include "transport/light_sample_variance.h"

namespace duet {

/// The techniques of a method, and how many samples each of them takes for a path.
struct TechniqueSet {
  bool hits = false;                ///< s = 0: the eye sub-path finds a light
  bool light_samples = false;       ///< s = 1: next event estimation
  bool camera_connections = false;  ///< t = 1: light vertices seen by the camera
  bool connections = false;         ///< s, t >= 2
  bool merges = false;              ///< eye and light vertices that are near each other, s, t >= 2

  float light_paths = 1;  ///< N_L: light sub-paths per iteration
  /// n_VC: samples of each connection per eye sub-path. Without connections it is no more than the
  /// unit of the sums.
  float connection_share = 1;
  float merge_area = 0;  ///< π r², of the merging disk
  /// Merging, beside connections, is part of the method in some pixels only. Sub-paths carry the
  /// sums of both methods then: without merges Partials::vm is what vc is, and with them it is vc /
  /// η, which need not be kept.
  bool partly_merged = false;
  /// Eye sub-paths that use one another's second vertices (WideEyeGroups): as many could have gone
  /// on to a diffuse vertex from a diffuse or glossy one that the camera sees.
  int pixel_group = 1;

  /// η = n_VM π r² / n_VC: by how much a merge outweighs the connection that it extends.
  float eta() const { return light_paths * merge_area / connection_share; }
  /// The merge at a vertex relative to the connections beside it, where both kinds exist.
  float merge_term() const { return merges ? eta() : 0.0f; }
  /// The reverse: the connection, or the light sample, relative to the merge.
  float connection_term() const { return merges && light_samples ? 1 / eta() : 0.0f; }
  /// What sub-paths take for it in Partials::vm, and for the merge at a vertex itself.
  float subpath_connection_term() const { return partly_merged ? 1.0f : connection_term(); }
  float subpath_merges() const { return partly_merged ? 0.0f : 1.0f; }
  /// What arrive() is told about connections.
  float subpath_connections() const { return connections ? 1.0f : 0.0f; }
};

/// What a sub-path knows at a vertex about the techniques that would have made its part of the path
/// from the other end: d^VCM, d^VC and d^VM of the source.
struct Partials {
  float vcm = 0, vc = 0, vm = 0;
};

/// A scattering event as the sums see it; densities are per solid angle at the vertex.
struct Departure {
  float forward;     ///< density of the direction taken
  float reverse;     ///< density of the direction back, for a sub-path from the other end
  float cosine_out;  ///< |cos| between the direction taken and the geometric normal; in a medium,
                     ///< where densities are per volume, the nominal extinction
};

/// The sums on leaving a vertex by a smooth lobe; arrive() completes them. `merges` is 0 instead of
/// 1 where nothing can be merged although the method merges elsewhere; so is `merge_term` then.
inline Partials leave(const Partials& at, const Departure& d, float merge_term,
                      float connection_term, float merges = 1) {
  const float to_next = d.cosine_out / d.forward;
  return {1 / d.forward, to_next * (merge_term + at.vcm + d.reverse * at.vc),
          to_next * (merges + at.vcm * connection_term + d.reverse * at.vm)};
}

/// The same where photons are merged if the method merges, or else never.
inline Partials leave(const Partials& at, const Departure& d, const TechniqueSet& set,
                      bool merges) {
  return leave(at, d, merges ? set.merge_term() : 0.0f, set.subpath_connection_term(),
               merges ? set.subpath_merges() : 0.0f);
}

/// The same through a delta lobe. `jacobian` is the solid angle of directions that arrive per solid
/// angle of directions that leave: |cos θ_in| n_in² / (|cos θ_out| n_out²), 1 for reflection. The
/// lobe is picked with the same probability from both ends.
inline Partials leave_specular(const Partials& at, float cosine_out, float jacobian) {
  const float factor = cosine_out * jacobian;
  return {0, factor * at.vc, factor * at.vm};
}

/// On arrival at the next vertex, at squared distance `d2` (1 from infinitely far away) under the
/// geometric cosine `cosine`. Through media `d2` is divided by the nominal transmittance, and in a
/// medium its nominal extinction takes the place of the cosine. `connections` is 0 instead of 1 if
/// the method does not connect this vertex with the one before: d^VCM stands for that technique.
inline Partials arrive(const Partials& p, float d2, float cosine, float connections) {
  const float inverse = 1 / cosine;
  return {connections * p.vcm * d2 * inverse, p.vc * inverse, p.vm * inverse};
}

/// One end of a connection, described by what the connection adds to its sub-path.
struct ConnectionEnd {
  float arrival;  ///< area density with which the other end's sub-path would have made this vertex
  float beyond;   ///< density per solid angle with which it would have gone on to the one before
  bool merges = false;  ///< whether photons may be merged at this vertex of the path
  LightSampleVariance
      light_sample{};  ///< of the path that has this end alone between lens and light
};

/// Relative density of all techniques that take vertices away from this end.
inline float beyond_end(const Partials& p, const ConnectionEnd& end, float merge_term) {
  return end.arrival * (merge_term + p.vcm + end.beyond * p.vc);
}

/// The merge of two vertices; `reverse` densities per solid angle of going back along each
/// sub-path.
inline float merge_weight(const Partials& light, float light_reverse, const Partials& eye,
                          float eye_reverse, float connection_term) {
  return 1 / (1 + light.vcm * connection_term + light_reverse * light.vm +
              eye.vcm * connection_term + eye_reverse * eye.vm);
}

}  // namespace duet
