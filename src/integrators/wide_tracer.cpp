#include "integrators/wide_tracer.h"

#include "integrators/next_event.h"
#include "materials/bsdf.h"

namespace duet {

void WideTracer::trace(int n, const BatchSampler& sampler, WideSamples& samples,
                       RenderCounters& counters) {
  Sums sums{samples, groups_.get()};
  if (groups_) groups_->start(pixel_count_, sampler.batch_key(paths_.keys));
  for (int depth = 1; n > 0; ++depth) {
    trace_rays(n, counters);
    if (depth == 1 && limits_.hide_emitters) pass_emitters(n, counters);
    n = end_outside(n, sums);
    counters.path_vertices += uint64_t(n);
    if (depth == limits_.max_depth) {
      find_emitting(n);
      add_emission(sums);
      for (int i = 0; i < n; ++i) samples.alpha[paths_.id[i]] = 1;
      break;
    }
    find_points(n);
    add_emission(sums);
    draw_numbers(n, sampler, depth);
    wide_.lights.sample(n, points_, numbers_, choice_, lights_);
    if (limits_.strict_normals) drop_two_sided_light_samples(n);
    look_up_textures();
    if (groups_) share_vertices(n, depth);
    choose_at_masks();
    evaluate_diffuse(n, paths_, points_, lights_);
    sample_diffuse(n, paths_, points_, numbers_, scattering_);
    evaluate_glossy_points(nullptr);
    sample_glossy_points(nullptr);
    sample_specular_points(nullptr);
    shade_perturbed_points();
    shade_masked_points();
    scatter_one_by_one();
    const bool splits = groups_ && depth == 2;
    if (splits) groups_->set_shares(vertices(), lights_);
    add_light(n, sums, counters);
    if (splits) groups_->set_shares(vertices(), scattering_);
    for (int i = 0; i < n; ++i)
      if (!scattering_.null[i]) samples.alpha[paths_.id[i]] = 1;
    if (limits_.strict_normals) drop_two_sided_directions(n);
    // Densities of second vertices know no roulette.
    const bool may_end = depth > 1 || !groups_;
    go_on(n, may_end ? roulette_at(depth, kPathRoulette) : std::nullopt, points_, scattering_,
          paths_);
    n = keep_alive(n);
  }
  if (groups_) groups_->add_to(samples, counters);
}

void WideTracer::share_vertices(int n, int depth) {
  if (depth == 1) groups_->note_first(n, paths_, {hits_, points_});
  if (depth == 2) groups_->note_second(n, paths_, {hits_, points_});
}

int WideTracer::end_outside(int n, Sums& sums) {
  const Scene& scene = wide_.scene;
  const int found = find_hits(n);
  if (found == n) return n;
  if (scene.environment)
    for (int i = 0; i < n; ++i)
      if (hits_.shape[i] == kNone && sees_environment(limits_, paths_.id[i], sums.samples)) {
        const Spectrum l = weighted_environment(scene, paths_.from.point(i),
                                                paths_.ray.direction.vector(i), bsdf_pdf(i), {});
        sums.add(paths_.id[i], throughput(i) * l);
        sums.samples.alpha[paths_.id[i]] = 1;
      }
  gaps_.fill(paths_);
  gaps_.fill(hits_);
  return found;
}

void WideTracer::add_emission(Sums& sums) const {
  for (const int i : emitting_) {
    const Ray ray = paths_.ray[i];
    const Surface s = wide_.scene.surface(ray, hit(i));
    sums.add(paths_.id[i],
             throughput(i) * weighted_emission(wide_.scene, s,
                                               {paths_.from.point(i), ray.direction, hits_.t[i]},
                                               bsdf_pdf(i), {}));
  }
}

void WideTracer::scatter_one_by_one() {
  for (size_t k = 0; k < special_.size(); ++k) {
    const int i = special_[k];
    const Surface& surface = surfaces_[k];
    if (wide_.shapes[hits_.shape[i]].model != WideModel::other) continue;
    const Bsdf bsdf = wide_.scene.materials[surface.shape->material]->bind(
        surface, -paths_.ray.direction.vector(i));
    BsdfEval f;
    if (bsdf.has_smooth() && !(lights_.pdf[i] < 0))
      f = bsdf.eval(lights_.wi.vector(i), Transport::radiance);
    lights_.value.set(i, f.value.r, f.value.g, f.value.b);
    lights_.bsdf_pdf[i] = f.pdf.value;
    scatter_at(i, bsdf);
  }
}

void WideTracer::add_light(int n, Sums& sums, RenderCounters& counters) {
  weigh_light_samples(n, paths_, points_, lights_, shadows_);
  counters.shadow_rays += uint64_t(test_shadows(n, shadows_, sums).rays);
}

int WideTracer::keep_alive(int n) {
  const int alive = find_alive(n);
  gaps_.fill(paths_);
  return alive;
}

}  // namespace duet
