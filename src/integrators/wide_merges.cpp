// Photons that a batch of eye sub-paths merges.
#include "integrators/wide_eye.h"

namespace duet {

void WideEye::locate_photons(int n) {
  around_.resize(size_t(n));
  for (int i = 0; i < n; ++i)
    if (merging_[size_t(paths_.id[i])])
      around_[size_t(i)] = plan_.photons->locate(points_.position.point(i));
}

void WideEye::merge(int n, int depth, WideSamples& samples, RenderCounters& counters) {
  const std::vector<LightVertex>& photons = plan_.lights->vertices().vertices;
  for (int i = 0; i < n; ++i) {
    const int id = paths_.id[i];
    const PathVertex* const special = special_vertex(i);
    if (!merging_[size_t(id)] || !carries(i) || !(special ? special->is_smooth() : is_smooth(i)))
      continue;
    if (special && !special->merges()) continue;
    ++counters.merge_queries;
    size_t share = find_photons(i, photons);
    const float kernel = float(share) / (plan_.set.merge_area * plan_.set.light_paths);
    const bool diffuse = wide_.shapes[hits_.shape[i]].model == WideModel::diffuse;
    Spectrum sum;
    for (const uint32_t index : photons_) {
      const LightVertex& photon = photons[index];
      if (int(photon.depth) + depth > limits_.max_depth) continue;
      const Connection found =
          diffuse ? merge_diffuse(i, photon, kernel)
                  : connect_merge(weights_[1], photon, eye_vertex(i, depth), kernel, false);
      if (found.value.is_black()) continue;
      ++counters.merges;
      sum += found.value * found.weight;
    }
    samples.add(id, sum);
  }
}

size_t WideEye::find_photons(int i, const std::vector<LightVertex>& photons) {
  uint64_t& random = random_[size_t(paths_.id[i])];
  const auto draw = [&] {
    random = mix64(random + 0x9e3779b97f4a7c15ull);
    return to_unit_float(uint32_t(random >> 32));
  };
  photons_.clear();
  size_t share = 1;
  plan_.photons->sample(points_.position.point(i), around_[size_t(i)], kMostMergedPhotons, draw,
                        [&](uint32_t index, float, size_t of) {
                          __builtin_prefetch(&photons[index]);
                          photons_.push_back(index);
                          share = of;
                        });
  return share;
}

Connection WideEye::merge_diffuse(int i, const LightVertex& photon, float kernel) const {
  const Vector3f wi = photon.direction_to_previous();
  const float cosine = std::abs(dot(points_.ng.vector(i), wi));
  const float pdf = dot(ends_.lit.vector(i), wi) * kInvPi;
  if (!(cosine > 0 && pdf > 0)) return {};
  const Vector3f flux = ends_.flux.vector(i);
  return {Spectrum(flux.x, flux.y, flux.z) * photon.throughput * (pdf * kernel / cosine),
          weights_[1].merge(photon.partials, pdf, partials(i), ends_.reverse[i])};
}

}  // namespace duet
