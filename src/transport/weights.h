// The ways to weigh joins (join.h) by the sums that walks carry along.
#pragma once

#include "transport/join.h"

namespace duet {

/// The balance heuristic over all techniques of a set, by running sums.
class BalanceWeights {
 public:
  explicit BalanceWeights(const TechniqueSet& set)
      : merge_term_(set.merge_term()),
        connection_term_(set.connection_term()),
        share_(set.connection_share),
        camera_scale_(set.connection_share / set.light_paths) {}

  float hit(const Walk& walk, float direct, float emission) const {
    return 1 / (1 + direct * walk.partials.vcm + share_ * emission * walk.partials.vc);
  }
  template <class Vertex>
  float light_sample(const Vertex& eye, float direct, float bsdf, const JoinEnd& eye_end) const {
    return 1 / (1 + bsdf / direct + share_ * beyond(eye, eye_end));
  }
  template <class Vertex>
  float camera(const Vertex& light, const JoinEnd& light_end) const {
    return 1 / (1 + camera_scale_ * beyond(light, light_end));
  }
  template <class Vertex>
  float connection(const Vertex& light, const JoinEnd& light_end, const Vertex& eye,
                   const JoinEnd& eye_end) const {
    return 1 / (1 + beyond(light, light_end) + beyond(eye, eye_end));
  }
  float merge(const LightVertex& light, float light_reverse, const PathVertex& eye,
              float eye_reverse) const {
    return merge_weight(light.partials, light_reverse, eye.partials, eye_reverse, connection_term_);
  }

 private:
  template <class Vertex>
  float beyond(const Vertex& v, const JoinEnd& end) const {
    return beyond_end(v.partials, end, v.merges() ? merge_term_ : 0.0f);
  }

  float merge_term_, connection_term_, share_, camera_scale_;
};

/// For methods in which each path can be made in one way only.
struct UnitWeights {
  float hit(const Walk&, float, float) const { return 1; }
  float light_sample(const PathVertex&, float, float, const JoinEnd&) const { return 1; }
  float camera(const PathVertex&, const JoinEnd&) const { return 1; }
  float connection(const PathVertex&, const JoinEnd&, const PathVertex&, const JoinEnd&) const {
    return 1;
  }
  float merge(const LightVertex&, float, const PathVertex&, float) const { return 1; }
};

}  // namespace duet
