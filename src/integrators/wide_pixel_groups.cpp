#include "integrators/wide_pixel_groups.h"

#include <algorithm>
#include <numeric>

#include "base/instruction_sets.h"
#include "integrators/wide_conductor.h"
#include "integrators/wide_dielectric.h"
#include "integrators/wide_kernels.h"
#include "integrators/wide_plastic.h"
#include "materials/plain_diffuse.h"
#include "math/hash.h"
#include "math/warp.h"

namespace duet {

namespace {

/// The side of the shading normal on which a diffuse point is lit, 0 if that is not the ray's.
float lit_side(const WidePoints& points, const WidePaths& paths, int i) {
  const float cosine = -dot(points.ns.vector(i), paths.ray.direction.vector(i));
  return PlainDiffuse::lit_side(cosine, points.two_sided[i] != 0);
}

/// Whether part of what such surfaces scatter is that of a diffuse base.
template <class Surface>
inline constexpr bool kHasBase =
    std::is_same_v<Surface, PlasticSurface> || std::is_same_v<Surface, RoughPlasticSurface>;

void copy_point(const WidePoints& from, int i, WidePoints& to, int k) {
  to.position.set(k, from.position.point(i));
  to.ng.set(k, from.ng.vector(i));
  to.ns.set(k, from.ns.vector(i));
  to.offset[k] = from.offset[i];
  to.reflectance.set(k, from.reflectance.vector(i));
  to.two_sided[k] = from.two_sided[i];
}

}  // namespace

WidePixelGroups::WidePixelGroups(const WideScene& scene, bool strict_normals, int members)
    : wide_(scene),
      strict_normals_(strict_normals),
      members_(members),
      place_(kBatch),
      pixel_(kBatch),
      glossy_pairs_(scene.glossy.size()),
      plastics_(scene.glossy.size()) {
  for (const WideGlossyMaterial& material : scene.glossy)
    is_plastic_.push_back(std::visit([]<class M>(const M&) { return kHasBase<M>; }, material));
}

void WidePixelGroups::start(int count, uint64_t key) {
  count_ = count;
  std::iota(pixel_.begin(), pixel_.end(), 0);
  for (int i = count - 1; i > 0; --i) {
    key = mix64(key + uint64_t(i));
    std::swap(pixel_[size_t(i)], pixel_[size_t((key >> 32) * uint64_t(i + 1) >> 32)]);
  }
  for (int i = 0; i < count; ++i) place_[size_t(pixel_[size_t(i)])] = i;
  std::fill_n(first_.list.begin(), count, -1);
  std::fill_n(second_.side.begin(), count, 0.0f);
  scattered_ = {};
}

void WidePixelGroups::note_first(int n, const WidePaths& paths, const Vertices& at) {
  for (int i = 0; i < n; ++i) {
    const WideShape& shape = wide_.shapes[at.hits.shape[i]];
    const bool diffuse = shape.model == WideModel::diffuse;
    // What masks, bump and normal maps do between two points is not known here.
    if (shape.is_covered() || (!diffuse && shape.model != WideModel::glossy)) continue;
    const float side = diffuse ? lit_side(at.points, paths, i) : 0.0f;
    // No path goes on from what is black, or not lit from the eye's side.
    if (diffuse && (side == 0 || !(reflectance_at(at.points, i).max() > 0))) continue;
    const int k = place_[size_t(paths.id[i])];
    first_.list[k] = shape.pair_list();
    first_.side[k] = side;
    first_.paths.ray.direction.set(k, paths.ray.direction.vector(i));
    copy_point(at.points, i, first_.points, k);
  }
}

void WidePixelGroups::note_second(int n, WidePaths& paths, const Vertices& at) {
  for (std::vector<int>& list : plastics_) list.clear();
  for (int i = 0; i < n; ++i) {
    const int k = place_[size_t(paths.id[i])];
    // What is mirrored no other pixel's path could have found.
    if (first_.list[k] < 0 || paths.bsdf_pdf[i] < 0) continue;
    const WideShape& shape = wide_.shapes[at.hits.shape[i]];
    const bool plastic = shape.model == WideModel::glossy && is_plastic_[size_t(shape.number)];
    if (shape.is_covered() || (shape.model != WideModel::diffuse && !plastic)) continue;
    const float side = lit_side(at.points, paths, i);
    if (side == 0) continue;
    if (plastic) plastics_[size_t(shape.number)].push_back(i);
    second_.side[k] = side;
    second_.list[k] = shape.pair_list();
    copy_point(at.points, i, second_.points, k);
    const Spectrum t = color_at(paths.throughput, i);
    const float scale = t.max();
    second_.scale[k] = scale;
    second_.tint.set(k, t.r / scale, t.g / scale, t.b / scale);
    second_.share.set(k, 1, 1, 1);
    paths.throughput.set(i, scale, scale, scale);
  }
}

template <class F>
void WidePixelGroups::set_base_shares(const WideVertices& at, const BatchTriples& towards,
                                      F&& value) {
  for (size_t number = 0; number < plastics_.size(); ++number) {
    const std::vector<int>& list = plastics_[number];
    if (list.empty()) continue;
    const int n = int(list.size());
    for (int k = 0; k < n; ++k) {
      glossy_.at[k] = list[size_t(k)];
      glossy_.towards.set(k, towards.vector(list[size_t(k)]));
    }
    const auto evaluate_base = [&]<class Surface>(Surface base) {
      if constexpr (kHasBase<Surface>) {
        base.plastic.specular_reflectance = Spectrum(0.0f);
        evaluate_glossy(n, base, at, glossy_);
      }
    };
    std::visit(evaluate_base, wide_.glossy[number]);
    for (int k = 0; k < n; ++k) {
      const int i = list[size_t(k)];
      const Vector3f base = glossy_.value.vector(k), all = value(i);
      const auto share = [](float part, float whole) {
        return whole > 0 ? std::min(part / whole, 1.0f) : 0.0f;
      };
      second_.share.set(place_[size_t(at.paths.id[i])], share(base.x, all.x), share(base.y, all.y),
                        share(base.z, all.z));
    }
  }
}

void WidePixelGroups::set_shares(const WideVertices& at, const WideLightSamples& samples) {
  set_base_shares(at, samples.wi, [&](int i) { return samples.value.vector(i); });
}

void WidePixelGroups::set_shares(const WideVertices& at, const WideScattering& next) {
  set_base_shares(at, next.wi,
                  [&](int i) { return next.weight.vector(i) * std::max(next.pdf[i], 0.0f); });
}

DUET_WIDEST void WidePixelGroups::find_pairs(const First& first, const Second& second, int place,
                                             Span group, int at, Pairs& pairs) {
  const Point3f to = second.points.position.point(place);
  const Vector3f ng2 = second.points.ng.vector(place);
  const Vector3f lit2 = second.points.ns.vector(place) * -second.side[place];
  const float offset2 = second.points.offset[place];
  const int n = group.size, begin = group.begin;
  DUET_LANES
  for (int k = 0; k < n; ++k) {
    const int i = begin + k, out = at + k;
    const Point3f from = first.points.position.point(i);
    const Vector3f ng = first.points.ng.vector(i);
    const Vector3f away = to - from;
    const float r2 = length_squared(away);
    const Vector3f d = away * (1 / std::sqrt(r2));
    const float side = first.side[i], cosine = dot(first.points.ns.vector(i), d);
    const float lit = side != 0 ? cosine * side : 1.0f;
    const float area = std::abs(dot(ng2, d)) / r2;
    const float seen = dot(lit2, d);
    const bool paired = first.list[i] >= 0 && r2 > 0 && seen > 0 && lit > 0;
    pairs.direction.set(out, d);
    pairs.cosine[out] = lit;
    pairs.geometry[out] = paired ? area : 0.0f;
    pairs.cosine_seen[out] = seen;
    const Point3f target = moved_off(to, ng2, offset2, -dot(ng2, d));
    const Point3f origin = moved_off(from, ng, first.points.offset[i], dot(ng, target - from));
    pairs.ray.origin.set(out, origin);
    pairs.ray.direction.set(out, target - origin);
    pairs.ray.tmax[out] = 0x1.fffep-1f;
  }
}

void WidePixelGroups::evaluate(int n) {
  for (std::vector<int>& list : glossy_pairs_) list.clear();
  for (int k = 0; k < n; ++k) {
    const int i = pairs_.first[k];
    const bool paired = pairs_.geometry[k] > 0;
    const float pdf = paired ? pairs_.cosine[k] * kInvPi * pairs_.geometry[k] : 0.0f;
    pairs_.pdf[k] = pdf;
    const Spectrum value = reflectance_at(first_.points, i) * pdf;
    pairs_.value.set(k, value.r, value.g, value.b);
    if (paired && first_.list[i] > 0) glossy_pairs_[size_t(first_.list[i] - 1)].push_back(k);
  }
  evaluate_glossy_pairs();
  see_plastics();
}

void WidePixelGroups::see_plastics() {
  for (const Shared& s : shared_) {
    const int list = second_.list[s.place], n = group_size(s.place);
    if (list == 0) continue;
    BatchArray<float>& seen = pairs_.seen;
    const auto see = [&]<class Surface>(const Surface& material) {
      if constexpr (kHasBase<Surface>)
        see_bases(n, material, &pairs_.cosine_seen[s.pairs], &seen[s.pairs]);
    };
    std::visit(see, wide_.glossy[size_t(list - 1)]);
    for (int k = s.pairs; k < s.pairs + n; ++k) {
      // Paths that see little of the base are weighted less than by their densities alone.
      pairs_.pdf[k] *= seen[k];
      pairs_.value.set(k, pairs_.value.vector(k) * seen[k]);
    }
  }
}

void WidePixelGroups::evaluate_glossy_pairs() {
  const WideVertices all{first_.paths, first_.points, numbers_};
  for (size_t number = 0; number < glossy_pairs_.size(); ++number) {
    const std::vector<int>& list = glossy_pairs_[number];
    if (list.empty()) continue;
    const int n = int(list.size());
    for (int k = 0; k < n; ++k) {
      glossy_.at[k] = pairs_.first[list[size_t(k)]];
      glossy_.towards.set(k, pairs_.direction.vector(list[size_t(k)]));
    }
    std::visit([&](const auto& material) { evaluate_glossy(n, material, all, glossy_); },
               wide_.glossy[number]);
    for (int k = 0; k < n; ++k) {
      const int pair = list[size_t(k)];
      const float geometry = pairs_.geometry[pair];
      const Vector3f value = glossy_.value.vector(k);
      // Where nothing is carried no path goes on.
      pairs_.pdf[pair] = max_abs(value) > 0 ? glossy_.value_pdf[k] * geometry : 0.0f;
      pairs_.value.set(pair, value * geometry);
    }
  }
}

void WidePixelGroups::test(int n, RenderCounters& counters) {
  int rays = 0;
  for (int k = 0; k < n; ++k) {
    if (!(pairs_.pdf[k] > 0)) continue;
    const int i = pairs_.first[k];
    if (strict_normals_ && sides_differ(first_.points.ng.vector(i), first_.points.ns.vector(i),
                                        pairs_.direction.vector(k))) {
      pairs_.pdf[k] = 0;
      continue;
    }
    if (i == pairs_.second[k]) continue;  // its own path has found it
    shadows_.ray.origin.set(rays, pairs_.ray.origin.point(k));
    shadows_.ray.direction.set(rays, pairs_.ray.direction.vector(k));
    shadows_.ray.tmax[rays] = pairs_.ray.tmax[k];
    shadows_.blocked[rays] = 0;
    shadows_.id[rays++] = k;
  }
  wide_.scene.accel->occluded(shadows_.ray, rays, shadows_.blocked);
  counters.shadow_rays += uint64_t(rays);
  for (int r = 0; r < rays; ++r)
    if (shadows_.blocked[r]) pairs_.pdf[shadows_.id[r]] = 0;
}

void WidePixelGroups::flush(int n, WideSamples& samples, RenderCounters& counters) {
  evaluate(n);
  test(n, counters);
  for (const Shared& s : shared_) {
    const int end = s.pairs + group_size(s.place), j = s.place;
    float sum = 0;
    for (int k = s.pairs; k < end; ++k) sum += pairs_.pdf[k];
    if (!(sum > 0)) continue;
    const Spectrum scattered = Spectrum(scattered_.r[j], scattered_.g[j], scattered_.b[j]) *
                               (1 / (sum * second_.scale[j]));
    for (int k = s.pairs; k < end; ++k) {
      if (!(pairs_.pdf[k] > 0)) continue;
      const BatchTriples& f = pairs_.value;
      samples.add(pixel_[size_t(pairs_.first[k])], scattered * Spectrum(f.x[k], f.y[k], f.z[k]));
    }
  }
  shared_.clear();
}

void WidePixelGroups::add_to(WideSamples& samples, RenderCounters& counters) {
  int n = 0;
  for (int j = 0; j < count_; ++j) {
    const bool black = scattered_.r[j] == 0 && scattered_.g[j] == 0 && scattered_.b[j] == 0;
    if (second_.side[j] == 0 || black) continue;
    const Span group{group_begin(j), group_size(j)};
    if (n + group.size > kBatch) flush(n, samples, counters), n = 0;
    find_pairs(first_, second_, j, group, n, pairs_);
    for (int k = 0; k < group.size; ++k)
      pairs_.first[n + k] = group.begin + k, pairs_.second[n + k] = j;
    shared_.push_back({j, n});
    n += group.size;
  }
  flush(n, samples, counters);
}

}  // namespace duet
