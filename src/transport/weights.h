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
  float light_sample(const PathVertex& eye, float direct, float bsdf,
                     const JoinEnd& eye_end) const {
    return 1 / (1 + bsdf / direct + share_ * beyond_end(eye.partials, eye_end, merge_term_));
  }
  float camera(const PathVertex& light, const JoinEnd& light_end) const {
    return 1 / (1 + camera_scale_ * beyond_end(light.partials, light_end, merge_term_));
  }
  float connection(const PathVertex& light, const JoinEnd& light_end, const PathVertex& eye,
                   const JoinEnd& eye_end) const {
    return connection_weight(light.partials, light_end, eye.partials, eye_end, merge_term_);
  }
  float merge(const LightVertex& light, float light_reverse, const PathVertex& eye,
              float eye_reverse) const {
    return merge_weight(light.partials, light_reverse, eye.partials, eye_reverse, connection_term_);
  }

 private:
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
