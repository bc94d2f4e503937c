#include "integrators/wide_eye.h"

#include "transport/weights.h"

namespace duet {

void WideEye::enter(std::span<const uint64_t> pixels) {
  starts_ = LightStarts(wide_.scene, plan_.guide);
  weights_[0] = BalanceWeights(plan_.set, false);
  weights_[1] = BalanceWeights(plan_.set);
  keys_.resize(pixels.size());
  random_.resize(pixels.size());
  merging_.resize(pixels.size());
  if (plan_.set.merges) {
    const size_t most = 2 * size_t(kPhotonsAtOnce) + VertexGrid::kListAtOnce;
    photon_entries_.resize(most);
    photon_points_.resize(most);
  }
  own_light_.resize(pixels.size());
  const LightVertices& vertices = plan_.lights->vertices();
  const size_t subpaths = vertices.ends.size();
  first_light_ = plan_.drawn ? 0 : ~0u;
  for (size_t id = 0; id < pixels.size(); ++id) {
    const uint64_t key = hash_combine(plan_.key, pixels[id]);
    keys_[id] = ~key;
    random_[id] = key;
    merging_[id] = plan_.set.merges && plan_.merges_in(pixels[id]);
    if (subpaths == 0 || plan_.drawn) continue;
    const size_t own = plan_.sharing->subpath(pixels[id], subpaths);
    own_light_[id] = uint32_t(own);
    first_light_ =
        std::min(first_light_, vertices.first(plan_.sharing->group(own, subpaths).first));
  }
  unpacked_.clear();
  unpacked_subpaths_.fill({});
}

void WideEye::begin(int n) {
  for (int i = 0; i < n; ++i) {
    subpaths_.vcm[i] = subpaths_.vc[i] = subpaths_.vm[i] = 0;
    subpaths_.carried[i] = 1;
    camera_origin_.set(paths_.id[i], paths_.ray.origin.point(i));
  }
}

Subpath WideEye::subpath(int i) const {
  Subpath s;
  s.ray = paths_.ray[i];
  s.throughput = throughput(i);
  s.partials = partials(i);
  s.from = paths_.from.point(i);
  s.from_specular = paths_.bsdf_pdf[i] < 0;
  return s;
}

void WideEye::trace(int n, const BatchSampler& sampler, WideSamples& samples,
                    RenderCounters& counters) {
  Sums sums{samples, groups_ ? &*groups_ : nullptr};
  if (groups_) groups_->start(int(keys_.size()), sampler.batch_key(paths_.keys));
  begin(n);
  for (int depth = 1; n > 0; ++depth) {
    trace_rays(n, counters);
    if (depth == 1 && limits_.hide_emitters) pass_emitters(n, counters);
    n = end_outside(n, sums, counters);
    counters.path_vertices += uint64_t(n);
    find_points(n);
    if (plan_.set.merges) plan_.photons->locate(n, points_.position, around_);
    add_emission(depth, sums, counters);
    if (depth == limits_.max_depth) {
      for (int i = 0; i < n; ++i) sums.samples.alpha[paths_.id[i]] = 1;
      break;
    }
    arrive_at_points(n, depth);
    draw_numbers(n, sampler, depth);
    wide_.lights.sample(n, points_, numbers_, choice_, lights_);
    if (limits_.strict_normals) drop_two_sided_light_samples(n);
    look_up_textures();
    if (groups_) share_vertices(n, depth);
    make_ends(n, paths_, subpaths_, points_, ends_);
    if (groups_ && depth == 2) groups_->count_paths(n, paths_, subpaths_, ends_);
    evaluate_diffuse(n, paths_, points_, lights_);
    evaluate_glossy_points(&ends_.reverse);
    sample_diffuse(n, paths_, points_, numbers_, scattering_);
    make_special_vertices(n, depth);
    sample_lights(n, depth, sums, counters);
    connect(n, depth, sums, counters);
    if (plan_.set.merges) merge(n, depth, sums, counters);
    sample_glossy_points(&ends_.reverse);
    sample_specular_points(&ends_.reverse);
    scatter_special_vertices();
    for (int i = 0; i < n; ++i)
      if (!scattering_.null[i]) sums.samples.alpha[paths_.id[i]] = 1;
    if (limits_.strict_normals) drop_two_sided_directions(n);
    // Densities of second vertices know no roulette.
    const bool may_end = depth > 1 || !groups_;
    go_on(
        n,
        {plan_.set, ends_, points_, may_end ? roulette_at(depth, kSubpathRoulette) : std::nullopt},
        scattering_, paths_, subpaths_);
    n = find_alive(n);
    fill_gaps();
  }
  if (groups_) groups_->add_to(samples, counters);
}

void WideEye::share_vertices(int n, int depth) {
  if (depth == 1) groups_->note_first(n, paths_, {hits_, points_}, subpaths_);
  if (depth == 2) groups_->note_second(n, paths_, {hits_, points_});
}

template <class F>
void WideEye::add_found(int i, Sums& sums, const F& connect) {
  const int id = paths_.id[i];
  Subpath s = subpath(i);
  const Connection c = connect(s);
  if (c.value.is_black()) return;
  float varying = 0;
  if (sums.shares(id)) {
    s.partials.vc -= s.partials.vm;
    varying = 1 - c.weight / connect(s).weight;
  }
  sums.add(id, c.value * c.weight, varying);
}

int WideEye::end_outside(int n, Sums& sums, RenderCounters& counters) {
  const int found = find_hits(n);
  if (found == n) return n;
  if (wide_.scene.environment)
    for (int i = 0; i < n; ++i) {
      const int id = paths_.id[i];
      if (hits_.shape[i] != kNone || !sees_environment(limits_, id, sums.samples)) continue;
      const ConnectionRoulette own = roulette(id);
      add_found(i, sums, [&](const Subpath& path) {
        return connect_escape(context(id, own, counters), path);
      });
      sums.samples.alpha[id] = 1;
    }
  gaps_.fill(hits_);
  fill_gaps();
  return found;
}

void WideEye::add_emission(int depth, Sums& sums, RenderCounters& counters) {
  for (const int i : emitting_) {
    const Surface s = wide_.scene.surface(paths_.ray[i], hit(i));
    const int id = paths_.id[i];
    const ConnectionRoulette own = roulette(id);
    add_found(i, sums, [&](const Subpath& path) {
      return connect_hit(context(id, own, counters), path, s, sqr(hits_.t[i]), depth);
    });
  }
}

void WideEye::arrive_at_points(int n, int depth) {
  arrive(n, hits_, points_, plan_.set.connections, paths_, subpaths_);
  for (int i = 0; i < n; ++i) {
    const auto id = size_t(paths_.id[i]);
    ends_.roulette[i] = ConnectionRoulette::seed_of(keys_[id]);
    ends_.merge_term[i] = merging_[id] ? plan_.set.merge_term() : 0.0f;
    ends_.unmerged[i] = plan_.set.partly_merged && !merging_[id];
  }
  if (depth > 1) return;
  for (int i = 0; i < n; ++i) {
    Ray ray = paths_.ray[i];
    ray.origin = camera_origin_.point(paths_.id[i]);
    const float cosine = std::abs(dot(points_.ng.vector(i), ray.direction));
    Subpath unused;
    const Partials p = first_eye_partials(
        wide_.scene, ray, {points_.position.point(i), sqr(hits_.t[i]), cosine}, plan_.set, unused);
    subpaths_.vcm[i] = cosine > 0 ? p.vcm : 0.0f;
  }
}

void WideEye::sample_lights(int n, int depth, Sums& sums, RenderCounters& counters) {
  if (wide_.scene.lights.empty()) return;
  wide_.lights.find_emission(n, starts_, points_, choice_, lights_);
  weigh_light_samples(n, connections(depth), lights_, shadows_);
  counters.shadow_rays += uint64_t(test_connections(n, shadows_, sums).rays);
}

}  // namespace duet
