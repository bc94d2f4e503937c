// The ways to weigh connections (connection.h) by the sums that sub-paths carry along.
#pragma once

#include "transport/connection.h"
#include "transport/merge_mask.h"

namespace duet {

/// Path tracing: light is found by rays and by light samples.
struct PathWeights {
  float hit(const Subpath& subpath, float direct, float, const LightSampleVariance&) const {
    return subpath.from_specular ? 1.0f : subpath.forward / (subpath.forward + direct);
  }
  template <class Vertex>
  float light_sample(const Vertex&, float direct, float bsdf, const ConnectionEnd&) const {
    return direct / (direct + bsdf);
  }
};

/// The same for methods that merge all light but what no photon may be merged for.
struct PhotonWeights : PathWeights {
  template <class Vertex>
  float light_sample(const Vertex& eye, float direct, float bsdf,
                     const ConnectionEnd& eye_end) const {
    return eye_end.merges ? 0.0f : PathWeights::light_sample(eye, direct, bsdf, eye_end);
  }
};

/// The balance heuristic over all techniques of a set, by running sums; light samples and hits
/// count for as many as LightSampleVariance says. With `merging` false they are those of a pixel in
/// which a partly merged method does not merge.
class BalanceWeights {
 public:
  explicit BalanceWeights(const TechniqueSet& set, bool merging = true)
      : partly_merged_(set.partly_merged),
        unmerged_(set.partly_merged && !merging),
        photons_(set.merges && !set.light_samples),
        merge_term_(unmerged_ ? 0.0f : set.merge_term()),
        connection_term_(set.connection_term()),
        share_(set.connection_share),
        camera_scale_(set.connection_share / set.light_paths) {}

  float hit(const Subpath& subpath, float direct, float emission,
            const LightSampleVariance& light_sample) const {
    if (photons_) return PhotonWeights().hit(subpath, direct, emission, light_sample);
    return 1 / (1 + direct * subpath.partials.vcm +
                share_ / light_sample.gain(0) * emission * connections(subpath.partials));
  }
  template <class Vertex>
  float light_sample(const Vertex& eye, float direct, float bsdf,
                     const ConnectionEnd& eye_end) const {
    if (photons_) return PhotonWeights().light_sample(eye, direct, bsdf, eye_end);
    const float gain = eye_end.light_sample.gain(pixel_area(eye.partials));
    return 1 / (1 + bsdf / direct + share_ / gain * beyond(eye, eye_end));
  }
  template <class Vertex>
  float camera(const Vertex& light, const ConnectionEnd& light_end) const {
    const float gain = light_end.light_sample.gain(1 / light_end.arrival);
    return 1 / (1 + camera_scale_ * beyond(light, light_end, gain));
  }
  template <class Vertex>
  float connection(const Vertex& light, const ConnectionEnd& light_end, const Vertex& eye,
                   const ConnectionEnd& eye_end) const {
    return 1 / (1 + beyond(light, light_end) + beyond(eye, eye_end));
  }
  float merge(const LightVertex& light, float light_reverse, const PathVertex& eye,
              float eye_reverse) const {
    return merge(light.partials_below(eye.depth, pixel_area(eye.partials)), light_reverse,
                 eye.partials, eye_reverse);
  }
  float merge(const Partials& light, float light_reverse, const Partials& eye,
              float eye_reverse) const {
    return merge_weight(merges(light), light_reverse, merges(eye), eye_reverse, connection_term_);
  }

 private:
  template <class Vertex>
  float beyond(const Vertex& v, const ConnectionEnd& end, float gain = 1) const {
    return beyond_end({gain * v.partials.vcm, gain * connections(v.partials), 0}, end,
                      end.merges ? merge_term_ : 0.0f);
  }
  float connections(const Partials& p) const { return unmerged_ ? p.vm : p.vc; }
  /// At the first eye vertex, of whose area the pixel has as much; 0 if no splats compete there.
  float pixel_area(const Partials& eye) const { return camera_scale_ * eye.vcm; }
  Partials merges(const Partials& p) const {
    return {p.vcm, p.vc, partly_merged_ ? p.vc * connection_term_ : p.vm};
  }

  bool partly_merged_, unmerged_;
  bool photons_;  ///< rays find lights and light samples are taken only where nothing is merged
  float merge_term_, connection_term_, share_, camera_scale_;
};

/// Those of light vertices that the camera sees: it depends on the pixel whether there are merges.
class MaskedWeights {
 public:
  MaskedWeights(const TechniqueSet& set, const MergeMask& mask)
      : merged_(set), unmerged_(set, false), mask_(mask) {}

  template <class Vertex>
  float camera(const Vertex& light, const ConnectionEnd& light_end, const Point2f& film) const {
    return (mask_.merges(film) ? merged_ : unmerged_).camera(light, light_end);
  }

 private:
  BalanceWeights merged_, unmerged_;
  const MergeMask& mask_;
};

/// For methods in which each path can be made in one way only, or as PhotonWeights have it.
struct UnitWeights : PhotonWeights {
  float camera(const PathVertex&, const ConnectionEnd&) const { return 1; }
  float connection(const PathVertex&, const ConnectionEnd&, const PathVertex&,
                   const ConnectionEnd&) const {
    return 1;
  }
  float merge(const LightVertex&, float, const PathVertex&, float) const { return 1; }
};

}  // namespace duet
