// What batches of light sub-paths do in loops over numbers: the same formulas as those of one
// (connection.h, subpath.h), so that the results are the same to rounding.
#pragma once

#include "integrators/wide_subpaths.h"

namespace duet {

/// How the lens sees the vertices of a batch; directions and targets are light samples.
struct WideSeen {
  BatchArray<float> film_x, film_y, importance;      ///< see CameraSample
  BatchArray<int32_t> other_lights, light_distance;  ///< LightSampleVariance of the vertices
  BatchArray<float> weight;                          ///< of the connections
  /// Eye sub-paths that could have gone on from there to the vertex before.
  BatchArray<float> eye_paths;

  void set_light_sample(int i, const LightSampleVariance& v) {
    other_lights[i] = v.others, light_distance[i] = v.distance;
  }
  LightSampleVariance light_sample(int i) const {
    LightSampleVariance v;
    v.others = uint8_t(other_lights[i]), v.distance = uint8_t(light_distance[i]);
    return v;
  }
};

/// What connections of the vertices of a batch with the lens have in common.
struct WideCameraConnections {
  const WidePaths& paths;
  const WideSubpaths& subpaths;
  const WidePoints& points;
  const WideEnds& ends;
  bool unit_weights;    ///< see LightPassPlan
  float scale;          ///< share of connections over the number of light sub-paths
  float threshold;      ///< of ConnectionRoulette
  uint32_t connection;  ///< ConnectionRoulette::event()
};

/// connect_camera(): contributions without weights, the weights, and the shadow rays, whose ids are
/// the numbers in the batch.
void weigh_camera(int n, const WideCameraConnections& c, const WideLightSamples& samples,
                  WideSeen& seen, WideShadowRays& out);
/// Multiplies the weights of the next directions by adjoint_factor().
void weigh_by_adjoint(int n, const WidePaths& paths, const WidePoints& points,
                      WideScattering& scattering);

}  // namespace duet
