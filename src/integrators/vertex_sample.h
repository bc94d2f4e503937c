// A sample of how a surface scatters light, by the random numbers of a path's vertex.
#pragma once

#include <optional>

#include "integrators/camera_integrator.h"

namespace duet {

/// From the dimensions that the `vertex`-th vertex of a path from the camera has.
inline std::optional<BsdfSample> sample_vertex(const Bsdf& bsdf, uint32_t vertex,
                                               Sampler& sampler) {
  sampler.start_dimension(kFirstVertexDimension + kDimensionsPerVertex * vertex +
                          kScatteringDimension);
  const Point2f v = sampler.next_2d();
  const float u = bsdf.needs_choice() ? sampler.next_1d() : 0.5f;
  return bsdf.sample(u, v, Transport::radiance);
}

}  // namespace duet
