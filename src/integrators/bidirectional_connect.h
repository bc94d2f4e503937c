// What the vertices of an eye sub-path are connected and merged with.
#pragma once

#include "integrators/bidirectional_eye.h"
#include "integrators/next_event.h"

namespace duet {

template <class Vertex, class Weights>
void BidirectionalIntegrator::connect(const Weights& weights, const Vertex& v, bool light_sample,
                                      Eye<Vertex>& eye) const {
  if (light_sample && !eye.scene.lights.empty())
    add(eye, 1, v.depth + 1,
        connect_light(eye.connections(weights, options_.strict_normals), v, eye.sampler));
  if (eye.merging && v.merges()) find_photons(v, eye);
  if (set_.connections) {
    if (options_.connections < 0)
      connect(weights, v, eye);
    else
      connect_to_cache(weights, v, eye);
  }
  if constexpr (!std::is_same_v<Weights, WindowWeights>)
    if (eye.merging && v.merges()) merge(weights, v, eye);
}

template <class Vertex>
bool BidirectionalIntegrator::samples_light(const Vertex& v, const Subpath& subpath) const {
  return set_.light_samples || (set_.merges && subpath.unmerged && v.bsdf.has_nearly_specular());
}

template <class Vertex>
int BidirectionalIntegrator::candidates(const Vertex& v, const Eye<Vertex>& eye) const {
  const LightVertices& light = lights_.vertices();
  if (!set_.connections || options_.connections >= 0 || light.ends.empty()) return 0;
  if (options_.method == Method::reuse && v.depth > windows_.eye) return 0;
  return std::clamp(max_depth_ - v.depth - 1, 0, int(light.lengths[light_subpath(v, eye)]));
}

template <class Vertex>
size_t BidirectionalIntegrator::light_subpath(const Vertex& v, const Eye<Vertex>& eye) const {
  // The thesis connects whole sub-paths with each other.
  if (options_.weights != ReuseWeights::exact) return eye.light_subpath;
  return sharing_.at_vertex(eye.light_subpath, lights_.vertices().ends.size(), v.depth);
}

template <class Vertex, class Weights>
void BidirectionalIntegrator::connect(const Weights& weights, const Vertex& v,
                                      Eye<Vertex>& eye) const {
  const int most = candidates(v, eye);
  if (most == 0) return;
  const size_t subpath = light_subpath(v, eye);
  Weights own = weights;
  if constexpr (std::is_same_v<Weights, WindowWeights>) own.set_light(lights_.pdfs(subpath));
  const ConnectionContext<Weights> connections = eye.connections(own, options_.strict_normals);
  int tried = 0;
  for (const LightVertex& l : lights_.vertices().subpath(subpath)) {
    if (int(l.depth) > most) break;
    if constexpr (Vertex::kMedia && std::is_same_v<Weights, WindowWeights>)
      own.set_light(lights_.pdfs(subpath), &lights_.end_pdfs(subpath)[size_t(tried)]);
    ++tried;
    add(eye, int(l.depth) + 1, v.depth + 1,
        connect_ends(connections, l.unpack<Vertex>(eye.scene), v));
  }
  eye.counters.connections.failed_specular += uint64_t(most - tried);
}

template <class Vertex, class Weights>
void BidirectionalIntegrator::connect_to_cache(const Weights& weights, const Vertex& v,
                                               Eye<Vertex>& eye) const {
  const ConnectionContext<Weights> connections = eye.connections(weights, options_.strict_normals);
  for (int i = 0; i < drawn_.count(); ++i) {
    const LightVertex& drawn = lights_.vertices().vertices[drawn_.draw(eye.key, v.depth, i)];
    if (int(drawn.depth) + v.depth + 1 > max_depth_) continue;
    add(eye, int(drawn.depth) + 1, v.depth + 1,
        connect_ends(connections, drawn.unpack<Vertex>(eye.scene), v, i, drawn_.scale()));
  }
}

template <class Vertex>
void BidirectionalIntegrator::find_photons(const Vertex& v, Eye<Vertex>& eye) const {
  const std::vector<LightVertex>& photons = lights_.vertices().vertices;
  ++eye.counters.merge_queries;
  eye.workspace.photons.clear();
  eye.photon_share = 1;
  grid_.sample(
      v.position(), eye.around, kMostMergedPhotons, [&] { return eye.draw(); },
      [&](uint32_t index, float, size_t share) {
        __builtin_prefetch(&photons[index]);
        eye.workspace.photons.push_back(index);
        eye.photon_share = float(share);
      });
}

template <class Vertex, class Weights>
void BidirectionalIntegrator::merge(const Weights& weights, const Vertex& v,
                                    Eye<Vertex>& eye) const {
  const float kernel = eye.photon_share / (set_.merge_area * set_.light_paths);
  for (const uint32_t index : eye.workspace.photons) {
    const LightVertex& photon = lights_.vertices().vertices[index];
    if (int(photon.depth) + v.depth > max_depth_) continue;
    const Connection found = connect_merge(weights, photon, v, kernel, options_.strict_normals);
    if (found.value.is_black()) continue;
    ++eye.counters.merges;
    eye.sum += found.value * found.weight;
    if (const size_t layer = layers_.merge(int(photon.depth) + 1, v.depth + 1))
      add_to_layer(eye.values, layer, raw_techniques_ ? found.value : found.value * found.weight);
  }
}

}  // namespace duet
