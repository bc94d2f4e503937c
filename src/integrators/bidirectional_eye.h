// An eye sub-path of the bidirectional methods while it is traced.
#pragma once

#include "integrators/bidirectional.h"

namespace duet {

/// What the eye sub-paths of one tile use one after the other, so that none of them allocates.
template <class Vertex>
struct EyeWorkspace {
  std::vector<uint32_t> photons;  ///< those near the vertex under way
  SubpathPdfs pdfs;
};

/// `Vertex` is the one of the scene: with media or without.
template <class Vertex>
struct BidirectionalWorkspace final : PathWorkspace {
  EyeWorkspace<Vertex> eye;
};

/// An eye sub-path under way.
template <class Vertex>
struct BidirectionalIntegrator::Eye {
  const Scene& scene;
  const LightStarts starts;
  const CameraPath& start;
  Sampler& sampler;
  RenderCounters& counters;
  std::span<float> values;
  ConnectionRoulette roulette;
  const uint64_t key;    ///< of numbers that no dimension of the sampler is set aside for
  uint64_t random;       ///< state of those that are drawn one after the other
  RandomStream shadows;  ///< for shadow rays through media
  EyeWorkspace<Vertex>& workspace;
  bool merging;  ///< in this pixel, if the method merges
  Spectrum sum{};
  size_t light_subpath = 0;           ///< the one that belongs to the pixel
  float photon_share = 1;             ///< for how many photons each of them stands
  VertexGrid::Neighborhood around{};  ///< where photons near the vertex under way are looked for

  /// What the vertices of the sub-path are connected with.
  template <class Weights>
  ConnectionContext<Weights> connections(const Weights& weights, bool strict_normals) {
    return {scene, starts, weights, roulette, counters, strict_normals, &shadows};
  }

  float draw() {
    random = mix64(random + 0x9e3779b97f4a7c15ull);
    return to_unit_float(uint32_t(random >> 32));
  }
};

inline void add_to_layer(std::span<float> values, size_t layer, const Spectrum& v) {
  values[layer] += v.r, values[layer + 1] += v.g, values[layer + 2] += v.b;
}

template <class Vertex>
void BidirectionalIntegrator::add(Eye<Vertex>& eye, int s, int t,
                                  const Connection& connection) const {
  eye.sum += connection.value * connection.weight;
  if (const size_t layer = layers_.connection(s, t))
    add_to_layer(eye.values, layer,
                 raw_techniques_ ? connection.value : connection.value * connection.weight);
}

}  // namespace duet
