#include "integrators/wide_tracer.h"

#include "integrators/next_event.h"
#include "integrators/wide_conductor.h"
#include "integrators/wide_plastic.h"
#include "materials/bsdf.h"

namespace duet {

namespace {

inline void add(WideSamples& samples, int id, const Spectrum& s) {
  samples.r[id] += s.r, samples.g[id] += s.g, samples.b[id] += s.b;
}

inline Hit hit_at(const HitBatch& hits, int i) {
  return {hits.t[i], hits.u[i], hits.v[i], hits.primitive[i], hits.shape[i], hits.instance[i]};
}

}  // namespace

void WideTracer::trace(int n, const BatchSampler& sampler, WideSamples& samples,
                       RenderCounters& counters) {
  for (int depth = 1; n > 0; ++depth) {
    counters.closest_rays += uint64_t(n);
    wide_.scene.accel->closest_hits(paths_.ray, n, hits_);
    n = end_outside(n, samples);
    counters.path_vertices += uint64_t(n);
    find_points(n);
    add_emission(samples);
    if (depth == limits_.max_depth) {
      for (int i = 0; i < n; ++i) samples.alpha[paths_.id[i]] = 1;
      break;
    }
    draw_numbers(n, sampler, depth);
    wide_.lights.sample(n, points_, numbers_, choice_, lights_);
    look_up_textures();
    evaluate_diffuse(n, paths_, points_, lights_);
    sample_diffuse(n, paths_, points_, numbers_, scattering_);
    scatter_glossy();
    scatter_one_by_one();
    add_light(n, samples, counters);
    for (int i = 0; i < n; ++i)
      if (!scattering_.null[i]) samples.alpha[paths_.id[i]] = 1;
    go_on(n, has_roulette(depth), points_, scattering_, paths_);
    n = keep_alive(n);
  }
}

int WideTracer::end_outside(int n, WideSamples& samples) {
  const Scene& scene = wide_.scene;
  const int found = gaps_.find(n, [&](int i) { return int(hits_.shape[i] != kNone); });
  if (found == n) return n;
  if (scene.environment)
    for (int i = 0; i < n; ++i)
      if (hits_.shape[i] == kNone) {
        const Spectrum l = weighted_environment(scene, paths_.from.point(i),
                                                paths_.ray.direction.vector(i), bsdf_pdf(i), {});
        add(samples, paths_.id[i], throughput(i) * l);
        samples.alpha[paths_.id[i]] = 1;
      }
  gaps_.fill(paths_);
  gaps_.fill(hits_);
  return found;
}

void WideTracer::find_points(int n) {
  fetch(n);
  if (wide_.has_normals)
    make_smooth_points(n, triangles_, hits_, points_);
  else
    make_points(n, triangles_, hits_, points_);
  surfaces_.resize(special_.size());
  for (size_t k = 0; k < special_.size(); ++k) {
    const int i = special_[k];
    const Surface& s = surfaces_[k] = wide_.scene.surface(paths_.ray[i], hit_at(hits_, i));
    points_.position.set(i, s.position);
    points_.ng.set(i, s.ng);
    points_.ns.set(i, s.shading.n);
    points_.offset[i] = s.offset;
    const WideShape& shape = wide_.shapes[hits_.shape[i]];
    if (shape.textured) set_reflectance(i, (*shape.textured)(s));
    if (!shape.textured && shape.prefetched) shape.prefetched->prefetch(s);
  }
  prefetch_textures();
}

/// What textures look up, without normals and tangents.
static Surface textured_point(const Shape& shape, const Point3f& position, const Hit& hit) {
  const TriangleMesh& m = *shape.mesh;
  ShapePoint p;
  p.position = position;
  p.barycentric = p.uv = {hit.u, hit.v};
  p.primitive = hit.primitive;
  if (shape.needs.uv && !m.uvs.empty()) {
    const std::array<uint32_t, 3>& t = m.triangles[hit.primitive];
    p.uv = m.uvs[t[0]] * (1 - hit.u - hit.v) + m.uvs[t[1]] * hit.u + m.uvs[t[2]] * hit.v;
  }
  return textured_point(shape, p);
}

void WideTracer::prefetch_textures() {
  textured_points_.resize(textured_.size());
  for (size_t k = 0; k < textured_.size(); ++k) {
    const int i = textured_[k];
    const uint32_t shape = hits_.shape[i];
    textured_points_[k] =
        textured_point(wide_.scene.shapes[shape], points_.position.point(i), hit_at(hits_, i));
    const Texture* const texture = wide_.shapes[shape].prefetched;
    if (texture) texture->prefetch(textured_points_[k]);
  }
}

void WideTracer::look_up_textures() {
  for (size_t k = 0; k < textured_.size(); ++k) {
    const int i = textured_[k];
    set_reflectance(i, (*wide_.shapes[hits_.shape[i]].textured)(textured_points_[k]));
  }
}

void WideTracer::fetch(int n) {
  special_.clear();
  emitting_.clear();
  textured_.clear();
  for (std::vector<int>& points : glossy_points_) points.clear();
  has_glossy_points_ = false;
  for (int i = 0; i < n; ++i) {
    const WideShape& shape = wide_.shapes[hits_.shape[i]];
    if (shape.emits) emitting_.push_back(i);
    set_reflectance(i, shape.reflectance);
    points_.two_sided[i] = shape.two_sided;
    if (shape.model == WideModel::glossy) {
      glossy_points_[size_t(shape.glossy)].push_back(i);
      has_glossy_points_ = true;
    }
    if (shape.model == WideModel::other || !shape.positions || hits_.instance[i] != kNone) {
      special_.push_back(i);
      continue;
    }
    if (shape.textured) textured_.push_back(i);
    const std::array<uint32_t, 3>& t = shape.triangles[hits_.primitive[i]];
    triangles_.sign[i] = shape.sign;
    triangles_.p0.set(i, shape.positions[t[0]]);
    triangles_.p1.set(i, shape.positions[t[1]]);
    triangles_.p2.set(i, shape.positions[t[2]]);
    if (!wide_.has_normals) continue;
    const Normal3f none(0);
    triangles_.n0.set(i, shape.normals ? shape.normals[t[0]] : none);
    triangles_.n1.set(i, shape.normals ? shape.normals[t[1]] : none);
    triangles_.n2.set(i, shape.normals ? shape.normals[t[2]] : none);
  }
}

void WideTracer::add_emission(WideSamples& samples) const {
  for (const int i : emitting_) {
    const Ray ray = paths_.ray[i];
    const Surface s = wide_.scene.surface(ray, hit_at(hits_, i));
    add(samples, paths_.id[i],
        throughput(i) * weighted_emission(wide_.scene, s,
                                          {paths_.from.point(i), ray.direction, hits_.t[i]},
                                          bsdf_pdf(i), {}));
  }
}

void WideTracer::draw_numbers(int n, const BatchSampler& sampler, int depth) {
  const uint32_t light = kFirstVertexDimension + kDimensionsPerVertex * uint32_t(depth - 1);
  const uint32_t scattering = light + kScatteringDimension;
  sampler.numbers_2d(n, paths_.keys, light, numbers_.light_x, numbers_.light_y);
  if (has_light_choice(wide_.scene))
    sampler.numbers_1d(n, paths_.keys, light + 2, numbers_.light_choice);
  sampler.numbers_2d(n, paths_.keys, scattering, numbers_.x, numbers_.y);
  const bool chooses = !special_.empty() || has_glossy_points_;
  if (chooses || has_roulette(depth))
    sampler.numbers_1d(n, paths_.keys, scattering + 2, numbers_.first);
  if (chooses && has_roulette(depth))
    sampler.numbers_1d(n, paths_.keys, scattering + 3, numbers_.second);
}

void WideTracer::scatter_glossy() {
  const WideVertices vertices{paths_, points_, numbers_};
  WideGlossy& p = glossy_;
  for (size_t number = 0; number < glossy_points_.size(); ++number) {
    const std::vector<int>& points = glossy_points_[number];
    if (points.empty()) continue;
    const int count = int(points.size());
    std::copy(points.begin(), points.end(), p.at.begin());
    const auto scatter = [&](const auto& material) {
      evaluate_glossy(count, material, vertices, lights_.wi, p);
      sample_glossy(count, material, vertices, p);
    };
    std::visit(scatter, wide_.glossy[number]);
    for (int k = 0; k < count; ++k) {
      const int i = p.at[k];
      lights_.value.set(i, p.value.vector(k));
      lights_.bsdf_pdf[i] = p.value_pdf[k];
      scattering_.wi.set(i, p.wi.vector(k));
      scattering_.weight.set(i, p.weight.vector(k));
      scattering_.pdf[i] = p.pdf[k];
      scattering_.roulette[i] = p.roulette[k];
      scattering_.alive[i] = p.alive[k];
      // sample_diffuse() has set the rest.
    }
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
    const bool chooses = bsdf.needs_choice();
    const auto sample = bsdf.sample(chooses ? numbers_.first[i] : 0.5f,
                                    {numbers_.x[i], numbers_.y[i]}, Transport::radiance);
    scattering_.alive[i] = sample.has_value();
    scattering_.null[i] = sample && sample->null;
    if (!sample) continue;
    scattering_.wi.set(i, sample->wi);
    scattering_.weight.set(i, sample->weight.r, sample->weight.g, sample->weight.b);
    scattering_.pdf[i] = sample->delta ? -1.0f : sample->pdf.value;
    scattering_.eta[i] = sample->eta;
    if (chooses) scattering_.roulette[i] = numbers_.second[i];
  }
}

void WideTracer::add_light(int n, WideSamples& samples, RenderCounters& counters) {
  weigh_light_samples(n, paths_, points_, lights_, shadows_);
  const int lit = gaps_.find(n, [&](int i) { return 1 - shadows_.blocked[i]; });
  gaps_.fill(shadows_);
  counters.shadow_rays += uint64_t(lit);
  wide_.scene.accel->occluded(shadows_.ray, lit, shadows_.blocked);
  for (int i = 0; i < lit; ++i)
    if (!shadows_.blocked[i])
      add(samples, shadows_.id[i],
          {shadows_.contribution.x[i], shadows_.contribution.y[i], shadows_.contribution.z[i]});
}

int WideTracer::keep_alive(int n) {
  const int alive = gaps_.find(n, [&](int i) { return scattering_.alive[i]; });
  gaps_.fill(paths_);
  return alive;
}

}  // namespace duet
