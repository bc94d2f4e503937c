#include "integrators/wide_stages.h"

#include "integrators/wide_conductor.h"
#include "integrators/wide_dielectric.h"
#include "integrators/wide_plastic.h"
#include "integrators/wide_principled.h"
#include "integrators/wide_specular.h"
#include "transport/light_choice.h"
#include "transport/shadow_transmittance.h"

namespace duet {

static void prefetch(const std::vector<const Texture*>& textures, const Surface& at) {
  for (const Texture* texture : textures) texture->prefetch(at);
}

void WideStages::trace_rays(int n, RenderCounters& counters) {
  counters.closest_rays += uint64_t(n);
  wide_.scene.accel->closest_hits(paths_.ray, n, hits_);
}

void WideStages::pass_emitters(int n, RenderCounters& counters) {
  for (int i = 0; i < n; ++i) {
    while (hits_.shape[i] != kNone && wide_.shapes[hits_.shape[i]].emits) {
      const Ray ray = beyond_hit(wide_.scene, paths_.ray[i], hit(i));
      paths_.ray.origin.set(i, ray.origin);
      paths_.ray.tmax[i] = ray.tmax;
      paths_.from.set(i, ray.origin);
      Hit found{};
      ++counters.closest_rays;
      if (!wide_.scene.accel->closest_hit(ray, found)) found.shape = kNone;
      hits_.t[i] = found.t, hits_.u[i] = found.u, hits_.v[i] = found.v;
      hits_.primitive[i] = found.primitive, hits_.shape[i] = found.shape;
      hits_.instance[i] = found.instance;
    }
  }
}

void WideStages::drop_two_sided_light_samples(int n) {
  for (int i = 0; i < n; ++i)
    if (has_two_sides(i, lights_.wi.vector(i))) lights_.pdf[i] = -1;
}

void WideStages::drop_two_sided_directions(int n) {
  for (int i = 0; i < n; ++i)
    if (has_two_sides(i, scattering_.wi.vector(i))) scattering_.alive[i] = 0;
}

void WideStages::find_points(int n) {
  fetch(n);
  if (wide_.has_normals)
    make_smooth_points(n, triangles_, {hits_.u, hits_.v}, points_);
  else
    make_points(n, triangles_, {hits_.u, hits_.v}, points_);
  surfaces_.resize(special_.size());
  for (size_t k = 0; k < special_.size(); ++k) {
    const int i = special_[k];
    const Surface& s = surfaces_[k] = wide_.scene.surface(paths_.ray[i], hit(i));
    points_.position.set(i, s.position);
    points_.ng.set(i, s.ng);
    points_.ns.set(i, s.shading.n);
    points_.offset[i] = s.offset;
    const WideShape& shape = wide_.shapes[hits_.shape[i]];
    if (shape.textured && !shape.perturbed)
      set_reflectance(i, (*shape.textured)(s));
    else if (shape.prefetched)
      prefetch(*shape.prefetched, s);
  }
  prefetch_textures();
}

void WideStages::find_emitting(int n) {
  emitting_.clear();
  for (int i = 0; i < n; ++i)
    if (wide_.shapes[hits_.shape[i]].emits) emitting_.push_back(i);
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

void WideStages::prefetch_textures() {
  textured_points_.resize(textured_.size());
  for (size_t k = 0; k < textured_.size(); ++k) {
    const int i = textured_[k];
    const uint32_t shape = hits_.shape[i];
    textured_points_[k] =
        textured_point(wide_.scene.shapes[shape], points_.position.point(i), hit(i));
    const auto* const textures = wide_.shapes[shape].prefetched;
    if (textures) prefetch(*textures, textured_points_[k]);
  }
}

void WideStages::look_up_textures() {
  for (size_t k = 0; k < textured_.size(); ++k) {
    const int i = textured_[k];
    const ColorSlot* const reflectance = wide_.shapes[hits_.shape[i]].textured;
    if (reflectance) set_reflectance(i, (*reflectance)(textured_points_[k]));
  }
  if (!wide_.maps.empty()) perturb_normals();
}

[[gnu::always_inline]] inline void WideStages::list_point(int i, const WideShape& shape) {
  if (shape.model != WideModel::glossy && shape.model != WideModel::specular) return;
  PointLists& lists = shape.model == WideModel::glossy ? glossy_points_ : specular_points_;
  lists[size_t(shape.number)].push_back(i);
  has_listed_points_ = true;
}

void WideStages::fetch(int n) {
  find_emitting(n);
  special_.clear();
  textured_.clear();
  for (std::vector<int>& points : glossy_points_) points.clear();
  for (std::vector<int>& points : specular_points_) points.clear();
  has_listed_points_ = false;
  const auto mesh = [this](int i) -> const WideMesh& { return wide_.shapes[hits_.shape[i]].mesh; };
  for (int i = 0; i < n; ++i) mesh(i).prefetch_triangle(hits_.primitive[i]);
  const auto prefetch_corners = [&](int i) { mesh(i).prefetch_corners(hits_.primitive[i]); };
  for (int i = 0; i < std::min(n, WideMesh::kAhead); ++i) prefetch_corners(i);
  for (int i = 0; i < n; ++i) {
    if (i + WideMesh::kAhead < n) prefetch_corners(i + WideMesh::kAhead);
    const WideShape& shape = wide_.shapes[hits_.shape[i]];
    set_reflectance(i, shape.reflectance);
    points_.two_sided[i] = shape.two_sided;
    list_point(i, shape);
    if (shape.model == WideModel::other || shape.perturbed || !shape.mesh.positions ||
        hits_.instance[i] != kNone) {
      special_.push_back(i);
      continue;
    }
    if (shape.looks_up) textured_.push_back(i);
    shape.mesh.get_corners(i, hits_.primitive[i], wide_.has_normals, triangles_);
  }
}

void WideStages::draw_numbers(int n, const BatchSampler& sampler, int depth) {
  const uint32_t light = kFirstVertexDimension + kDimensionsPerVertex * uint32_t(depth - 1);
  sampler.numbers_2d(n, paths_.keys, light, numbers_.light_x, numbers_.light_y);
  if (has_light_choice(wide_.scene))
    sampler.numbers_1d(n, paths_.keys, light + 2, numbers_.light_choice);
  draw_scattering(n, sampler, light + kScatteringDimension, depth);
}

void WideStages::draw_scattering(int n, const BatchSampler& sampler, uint32_t dimension,
                                 int depth) {
  sampler.numbers_2d(n, paths_.keys, dimension, numbers_.x, numbers_.y);
  const bool chooses = !special_.empty() || has_listed_points_ || !wide_.masks.empty();
  if (chooses || has_roulette(depth))
    sampler.numbers_1d(n, paths_.keys, dimension + 2, numbers_.first);
  if (chooses && has_roulette(depth))
    sampler.numbers_1d(n, paths_.keys, dimension + 3, numbers_.second);
}

template <class Material, class F>
void WideStages::for_each_material(const PointLists& lists, const std::vector<Material>& materials,
                                   F&& f) {
  for (size_t number = 0; number < lists.size(); ++number) {
    const std::vector<int>& points = lists[number];
    if (points.empty()) continue;
    std::copy(points.begin(), points.end(), glossy_.at.begin());
    f(int(points.size()), materials[number]);
  }
}

/// Calls `f` with the material itself.
template <class F>
static auto with_model(F&& f) {
  return [f](int count, const WideGlossyMaterial& material) {
    std::visit([&](const auto& m) { f(count, m); }, material);
  };
}

void WideStages::evaluate_glossy_points(BatchArray<float>* reverse) {
  const WideVertices all = vertices();
  WideGlossy& p = glossy_;
  const auto evaluate = [&](int count, const auto& material) {
    for (int k = 0; k < count; ++k) p.towards.set(k, lights_.wi.vector(p.at[k]));
    evaluate_glossy(count, material, all, p);
    if (reverse) reverse_glossy(count, material, all, p);
    for (int k = 0; k < count; ++k) {
      const int i = p.at[k];
      lights_.value.set(i, p.value.vector(k));
      lights_.bsdf_pdf[i] = p.value_pdf[k];
      if (reverse) (*reverse)[i] = p.reverse[k];
    }
  };
  for_each_material(glossy_points_, wide_.glossy, with_model(evaluate));
}

void WideStages::set_scattering(int k, BatchArray<float>* reverse) {
  const WideGlossy& p = glossy_;
  const int i = p.at[k];
  scattering_.wi.set(i, p.wi.vector(k));
  scattering_.weight.set(i, p.weight.vector(k));
  scattering_.pdf[i] = p.pdf[k];
  scattering_.roulette[i] = p.roulette[k];
  scattering_.alive[i] = p.alive[k];
  if (reverse) (*reverse)[i] = p.reverse[k];
}

/// Of directions that a plastic mirrors: specular_jacobian().
static void set_jacobians(int n, WideGlossy& p) {
  for (int k = 0; k < n; ++k)
    if (p.pdf[k] < 0) p.reverse[k] = 1;
}

void WideStages::sample_glossy_points(BatchArray<float>* reverse) {
  const WideVertices all = vertices();
  WideGlossy& p = glossy_;
  const auto sample = [&](int count, const auto& material) {
    sample_glossy(count, material, all, p);
    if (reverse) {
      p.towards = p.wi;
      reverse_glossy(count, material, all, p);
      if constexpr (std::is_same_v<decltype(material), const PlasticSurface&>)
        set_jacobians(count, p);
    }
    // sample_diffuse() has set the rest.
    for (int k = 0; k < count; ++k) set_scattering(k, reverse);
    if constexpr (std::is_same_v<decltype(material), const RoughDielectricSurface&>)
      for (int k = 0; k < count; ++k) scattering_.eta[p.at[k]] = p.eta[k];
  };
  for_each_material(glossy_points_, wide_.glossy, with_model(sample));
}

void WideStages::sample_specular_points(BatchArray<float>* reverse) {
  const WideVertices all = vertices();
  for_each_material(specular_points_, wide_.specular, [&](int count, const auto& surface) {
    sample_specular(count, surface, all, glossy_);
    for (int k = 0; k < count; ++k) {
      set_scattering(k, reverse);
      scattering_.eta[glossy_.at[k]] = glossy_.eta[k];
      scattering_.null[glossy_.at[k]] = glossy_.null[k];
    }
  });
}

std::optional<BsdfSample> WideStages::scatter_at(int i, const Bsdf& bsdf) {
  const bool chooses = bsdf.needs_choice();
  const auto sample =
      bsdf.sample(chooses ? numbers_.first[i] : 0.5f, {numbers_.x[i], numbers_.y[i]}, transport_);
  scattering_.alive[i] = sample.has_value();
  scattering_.null[i] = sample && sample->null;
  if (!sample) return sample;
  scattering_.wi.set(i, sample->wi);
  scattering_.weight.set(i, sample->weight.r, sample->weight.g, sample->weight.b);
  scattering_.pdf[i] = sample->delta ? -1.0f : sample->pdf.value;
  // Sub-paths from the lights carry no more into a denser medium.
  scattering_.eta[i] = transport_ == Transport::radiance ? sample->eta : 1.0f;
  if (chooses) scattering_.roulette[i] = numbers_.second[i];
  return sample;
}

int WideStages::find_unblocked(int n, WideShadowRays& rays) {
  const int count = gaps_.find(n, [&](int i) { return int(rays.blocked[i] == 0); });
  gaps_.fill(rays);
  wide_.scene.accel->occluded(rays.ray, count, rays.blocked);
  return count;
}

}  // namespace duet
