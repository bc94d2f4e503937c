#include "integrators/wide_light_walk.h"

namespace duet {

void WideLightTracer::trace(const LightPassPlan& plan, LightRange range, LightBlock& block) {
  auto walk = walks_.take([&] { return std::make_unique<WideLightWalk>(scene_); });
  walk->trace(plan, range, block);
  walks_.give_back(std::move(walk));
}

void WideLightWalk::trace(const LightPassPlan& plan, LightRange range, LightBlock& block) {
  plan_ = &plan;
  limits_.max_depth = plan.max_depth, limits_.rr_depth = plan.subpath.rr_depth;
  limits_.hide_emitters = plan.hide_emitters, limits_.strict_normals = plan.subpath.strict_normals;
  BatchSampler sampler(plan.sequence, plan.sampler_seed(), plan.scramble);
  for (uint32_t first = range.first; first < range.end; first += kBatch) {
    const uint32_t end = std::min(first + kBatch, range.end);
    const int n = start({first, end}, sampler);
    block.counters.light_paths += end - first;
    trace_batch(n, sampler, block);
    append_kept(int(end - first), block);
  }
}

int WideLightWalk::start(LightRange range, BatchSampler& sampler) {
  const int count = int(range.end - range.first);
  const LightStarts starts(wide_.scene, plan_->guide);
  for (int id = 0; id < count; ++id)
    pixel_keys_[id] = sampler.pixel_key(range.first + uint32_t(id));
  sampler.start_sample(plan_->iteration, count, pixel_keys_, keys_);
  BatchArray<float>&choice = numbers_.light_choice, &x = numbers_.light_x, &y = numbers_.light_y;
  sampler.numbers_1d(count, keys_, 0, choice);
  sampler.numbers_2d(count, keys_, 1, x, y);
  sampler.numbers_2d(count, keys_, 3, numbers_.x, numbers_.y);
  starts_.resize(size_t(count));
  roulette_.resize(size_t(count));
  lengths_.assign(size_t(count), 0);
  eye_paths_.assign(size_t(count), 1);
  int n = 0;
  for (int id = 0; id < count; ++id) {
    roulette_[size_t(id)] = ConnectionRoulette::seed_of(plan_->key(range.first + uint32_t(id)));
    auto& start = starts_[size_t(id)] = start_light_subpath(
        wide_.scene, starts, {choice[id], {x[id], y[id]}, {numbers_.x[id], numbers_.y[id]}});
    if (!start || limits_.max_depth < 1) continue;
    const Ray& ray = start->subpath.ray;
    const Spectrum& flux = start->subpath.throughput;
    paths_.ray.origin.set(n, ray.origin);
    paths_.ray.direction.set(n, ray.direction);
    paths_.ray.tmax[n] = ray.tmax;
    paths_.throughput.set(n, flux.r, flux.g, flux.b);
    paths_.id[n] = id;
    paths_.keys.high[n] = keys_.high[id], paths_.keys.low[n] = keys_.low[id];
    subpaths_.carried[n] = 1;
    ++n;
  }
  return n;
}

void WideLightWalk::trace_batch(int n, const BatchSampler& sampler, LightBlock& block) {
  uint32_t dimension = kLightStartDimensions;
  for (int depth = 1; n > 0; ++depth, dimension += kLightVertexDimensions) {
    trace_rays(n, block.counters);
    n = end_outside(n);
    find_points(n);
    arrive_at_points(n, depth);
    look_at_lens(n, sampler, dimension + kLensOffset);
    look_up_textures();
    make_ends(n, paths_, subpaths_, points_, ends_);
    if (plan_->set.camera_connections) {
      evaluate_diffuse(n, paths_, points_, lights_);
      evaluate_glossy_points(&ends_.reverse);
    }
    make_special_vertices(n, depth);
    if (plan_->set.camera_connections) connect_lens(n, depth, block);
    if (plan_->keep_vertices) keep_vertices(n, depth);
    if (depth == limits_.max_depth) break;
    scatter(n, sampler, dimension, depth);
    n = find_alive(n);
    fill_gaps();
  }
}

int WideLightWalk::end_outside(int n) {
  const int found = find_hits(n);
  gaps_.fill(hits_);
  fill_gaps();
  return found;
}

void WideLightWalk::arrive_at_points(int n, int depth) {
  if (depth > 1) arrive(n, hits_, points_, plan_->set.connections, paths_, subpaths_);
  for (int i = 0; i < n; ++i) {
    LightSampleVariance light_sample;
    if (depth == 1) light_sample = arrive_first(i);
    if (limits_.strict_normals && has_two_sides(i, paths_.ray.direction.vector(i)))
      paths_.throughput.set(i, 0, 0, 0);
    seen_.set_light_sample(i, light_sample);
    if (carries(i)) lengths_[size_t(paths_.id[i])] = depth;
  }
}

LightSampleVariance WideLightWalk::arrive_first(int i) {
  const LightStart& start = *starts_[size_t(paths_.id[i])];
  const Point3f position = points_.position.point(i);
  const float cosine = std::abs(dot(points_.ng.vector(i), start.subpath.ray.direction));
  Partials p;
  StartByLightSample direct;
  if (cosine > 0 && !start.is_before_entry(position)) {
    direct = start.direct(position);
    p = first_light_partials(start, direct.density, cosine, plan_->set);
  } else {
    paths_.throughput.set(i, 0, 0, 0);
  }
  subpaths_.vcm[i] = p.vcm, subpaths_.vc[i] = p.vc, subpaths_.vm[i] = p.vm;
  return plan_->set.light_samples ? direct.variance : LightSampleVariance{};
}

void WideLightWalk::look_at_lens(int n, const BatchSampler& sampler, uint32_t dimension) {
  for (int i = 0; i < n; ++i) lights_.pdf[i] = -1;
  const TechniqueSet& set = plan_->set;
  if (!set.camera_connections) return;
  const Camera& camera = *wide_.scene.camera;
  BatchArray<float>&lens_x = numbers_.light_x, &lens_y = numbers_.light_y;
  if (camera.has_lens()) sampler.numbers_2d(n, paths_.keys, dimension, lens_x, lens_y);
  for (int i = 0; i < n; ++i) {
    const Point2f lens = camera.has_lens() ? Point2f{lens_x[i], lens_y[i]} : Point2f{};
    const bool hidden = limits_.hide_emitters && wide_.shapes[hits_.shape[i]].emits;
    const auto seen = carries(i) && !hidden ? camera.sample_lens(points_.position.point(i), lens)
                                            : std::optional<CameraSample>();
    if (!seen) continue;
    lights_.pdf[i] = 1;
    lights_.finite[i] = 1;
    lights_.wi.set(i, seen->direction);
    lights_.target.set(i, seen->target);
    seen_.film_x[i] = seen->film.x, seen_.film_y[i] = seen->film.y;
    seen_.importance[i] = seen->importance;
    const bool may_be_first = wide_.shapes[hits_.shape[i]].may_be_first();
    seen_.eye_paths[i] = may_be_first ? eye_paths_[size_t(paths_.id[i])] : 1.0f;
    const bool merges = set.merges && (!set.partly_merged || plan_->mask->merges(seen->film));
    ends_.merge_term[i] = merges ? set.merge_term() : 0.0f;
    ends_.unmerged[i] = set.partly_merged && !merges;
    ends_.roulette[i] = roulette_[size_t(paths_.id[i])];
  }
}

void WideLightWalk::connect_lens(int n, int depth, LightBlock& block) {
  const TechniqueSet& set = plan_->set;
  weigh_camera(n,
               {paths_, subpaths_, points_, ends_, plan_->unit_weights,
                set.connection_share / set.light_paths, plan_->roulette_threshold,
                ConnectionRoulette::event(depth, 0)},
               lights_, seen_, shadows_);
  const struct {
    const WideSeen& seen;
    int depth;
    std::vector<LightSplat>& splats;
    void add(int i, const Spectrum& value) const {
      splats.push_back({{{seen.film_x[i], seen.film_y[i]}, value}, seen.weight[i], depth});
    }
  } sums{seen_, depth, block.splats};
  const int rays = find_unblocked(n, shadows_);
  block.counters.shadow_rays += uint64_t(rays);
  if (limits_.hide_emitters) see_past_emitters(rays, block.counters);
  add_lit(rays, shadows_, sums);
}

void WideLightWalk::see_past_emitters(int rays, RenderCounters& counters) {
  for (int i = 0; i < rays; ++i) {
    if (!shadows_.blocked[i]) continue;
    --counters.shadow_rays;  // which are counted again
    shadows_.blocked[i] = occluded_by_others(wide_.scene, shadows_.ray[i], counters);
  }
}

void WideLightWalk::scatter(int n, const BatchSampler& sampler, uint32_t dimension, int depth) {
  draw_scattering(n, sampler, dimension, depth);
  sample_diffuse(n, paths_, points_, numbers_, scattering_);
  sample_glossy_points(&ends_.reverse);
  sample_specular_points(&ends_.reverse);
  scatter_special_vertices();
  weigh_by_adjoint(n, paths_, points_, scattering_);
  if (plan_->set.pixel_group > 1)
    for (int i = 0; i < n; ++i)
      eye_paths_[size_t(paths_.id[i])] =
          wide_.shapes[hits_.shape[i]].may_be_second() ? float(plan_->set.pixel_group) : 1.0f;
  go_on(n, {plan_->set, ends_, points_, roulette_at(depth, kSubpathRoulette)}, scattering_, paths_,
        subpaths_);
}

void WideLightWalk::keep_vertices(int n, int depth) {
  for (int i = 0; i < n; ++i) {
    if (!carries(i)) continue;
    const PathVertex* const special = special_vertex(i);
    if (!(special ? special->is_smooth() : is_smooth(i))) continue;
    if (!plan_->set.connections && special && !special->merges()) continue;
    kept_ids_.push_back(paths_.id[i]);
    if (special)
      kept_.emplace_back(*special, hit(i));
    else
      kept_.push_back(light_vertex(i, depth));
    kept_.back().set_light_sample(seen_.light_sample(i));
    if (!plan_->keep_connection_vertices) continue;
    if (special)
      kept_connection_vertices_.emplace_back(*special);
    else
      kept_connection_vertices_.push_back(connection_vertex(i, depth));
  }
}

LightVertex WideLightWalk::light_vertex(int i, int depth) const {
  const Hit at = hit(i);
  const ShapeKind kind = wide_.scene.shapes[at.shape].kind;
  // Where a method merges, points of materials that may not be merged are special.
  const Vector3f direction = paths_.ray.direction.vector(i);
  return {{points_.position.point(i), -direction, std::abs(dot(points_.ng.vector(i), direction)),
           throughput(i), partials(i), depth, true,
           kind == ShapeKind::mesh ? Point2f{at.u, at.v} : Point2f{}},
          at};
}

ConnectionVertex WideLightWalk::connection_vertex(int i, int depth) const {
  ConnectionVertex v;
  v.depth = depth;
  v.position = points_.position.point(i);
  const WideShape& shape = wide_.shapes[hits_.shape[i]];
  v.lit = shape.transmits ? points_.ns.normal(i) : ends_.lit.normal(i);
  v.faces = shape.transmits ? 0 : 1;
  v.shareable = shape.may_be_second() ? 1 : 0;
  const bool glossy = shape.model == WideModel::glossy;
  const BatchTriples& flux = glossy ? points_.reflectance : ends_.flux;
  v.material = glossy ? shape.pair_list() : ConnectionVertex::kDiffuse;
  v.offset = points_.offset[i];
  v.ng = points_.ng.normal(i);
  v.flux = {flux.x[i], flux.y[i], flux.z[i]};
  const Vector3f direction = paths_.ray.direction.vector(i);
  v.set_cosines(dot(points_.ns.vector(i), direction), dot(points_.ng.vector(i), direction));
  v.vcm = subpaths_.vcm[i], v.vc = subpaths_.vc[i], v.vm = subpaths_.vm[i];
  return v;
}

void WideLightWalk::append_kept(int subpaths, LightBlock& block) {
  std::vector<LightVertex>& vertices = block.vertices.vertices;
  auto end = uint32_t(vertices.size());
  places_.assign(size_t(subpaths), 0);
  for (const int32_t id : kept_ids_) ++places_[size_t(id)];
  for (int id = 0; id < subpaths; ++id) {
    const uint32_t count = places_[size_t(id)];
    places_[size_t(id)] = end;
    end += count;
    block.end_subpath(end, lengths_[size_t(id)]);
  }
  vertices.resize(end);
  if (plan_->keep_connection_vertices) block.connection_vertices.resize(end);
  for (size_t k = 0; k < kept_.size(); ++k) {
    const uint32_t place = places_[size_t(kept_ids_[k])]++;
    vertices[place] = kept_[k];
    if (plan_->keep_connection_vertices)
      block.connection_vertices[place] = kept_connection_vertices_[k];
  }
  kept_.clear();
  kept_connection_vertices_.clear();
  kept_ids_.clear();
}

}  // namespace duet
