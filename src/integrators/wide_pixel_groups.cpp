#include "integrators/wide_pixel_groups.h"

#include <algorithm>
#include <numeric>

#include "base/instruction_sets.h"
#include "integrators/wide_conductor.h"
#include "integrators/wide_dielectric.h"
#include "integrators/wide_kernels.h"
#include "integrators/wide_plastic.h"
#include "integrators/wide_principled.h"
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

void copy_point(const WidePoints& from, int i, WidePoints& to, int k) {
  to.position.set(k, from.position.point(i));
  to.ng.set(k, from.ng.vector(i));
  to.ns.set(k, from.ns.vector(i));
  to.offset[k] = from.offset[i];
  to.reflectance.set(k, from.reflectance.vector(i));
  to.two_sided[k] = from.two_sided[i];
}

}  // namespace

WidePixelGroups::WidePixelGroups(const WideScene& scene, bool strict_normals, int members,
                                 bool bases)
    : wide_(scene),
      members_(members),
      plastics_(scene.glossy.size()),
      strict_normals_(strict_normals),
      place_(kBatch),
      pixel_(kBatch),
      glossy_pairs_(scene.glossy.size()) {
  for (const WideGlossyMaterial& material : scene.glossy)
    is_shared_plastic_.push_back(
        bases && std::visit([]<class M>(const M&) { return kHasBase<M>; }, material));
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
  for (int k = 0; k < count; ++k) sums_.set(k, 0, 0, 0);
  has_glossy_ = false;
}

void WidePixelGroups::note_first(int n, const WidePaths& paths, const Vertices& at) {
  for (int i = 0; i < n; ++i) {
    const WideShape& shape = wide_.shapes[at.hits.shape[i]];
    const bool diffuse = shape.model == WideModel::diffuse;
    if (!shape.may_be_first()) continue;
    const float side = diffuse ? lit_side(at.points, paths, i) : 0.0f;
    // No path goes on from what is black, or not lit from the eye's side.
    if (diffuse && (side == 0 || !(reflectance_at(at.points, i).max() > 0))) continue;
    const int k = place_[size_t(paths.id[i])];
    first_.list[k] = shape.pair_list();
    has_glossy_ |= !diffuse;
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
    const bool plastic = shape.may_be_first() && shape.model == WideModel::glossy &&
                         is_shared_plastic_[size_t(shape.number)];
    if (!shape.may_be_second() && !plastic) continue;
    const float side = lit_side(at.points, paths, i);
    const Spectrum t = color_at(paths.throughput, i);
    const float scale = t.max();
    if (side == 0 || !(scale > 0)) continue;
    if (plastic) plastics_[size_t(shape.number)].push_back(i);
    second_.side[k] = side;
    second_.list[k] = shape.pair_list();
    copy_point(at.points, i, second_.points, k);
    second_.scale[k] = scale;
    second_.tint.set(k, t.r / scale, t.g / scale, t.b / scale);
    paths.throughput.set(i, scale, scale, scale);
  }
}

DUET_WIDEST void WidePixelGroups::find_pairs(const First& first, const Second& second,
                                             const Shared& s, Pairs& pairs) {
  const Point3f to = second.points.position.point(s.place);
  const Vector3f ng2 = second.points.ng.vector(s.place);
  const Vector3f lit2 = second.points.ns.vector(s.place) * -second.side[s.place];
  const float offset2 = second.points.offset[s.place];
  const int n = s.group.size, begin = s.group.begin, at = s.pairs, place = s.place;
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
    const float geometry = paired ? area : 0.0f, pdf = paired ? lit * kInvPi * area : 0.0f;
    pairs.first[out] = i;
    pairs.second[out] = place;
    pairs.direction.set(out, d);
    pairs.geometry[out] = geometry;
    pairs.cosine_seen[out] = seen;
    pairs.pdf[out] = pdf;
    pairs.value.set(out, first.points.reflectance.x[i] * pdf, first.points.reflectance.y[i] * pdf,
                    first.points.reflectance.z[i] * pdf);
    const Point3f target = moved_off(to, ng2, offset2, -dot(ng2, d));
    const Point3f origin = moved_off(from, ng, first.points.offset[i], dot(ng, target - from));
    pairs.ray.origin.set(out, origin);
    pairs.ray.direction.set(out, target - origin);
  }
}

void WidePixelGroups::evaluate(int n) {
  if (has_glossy_) evaluate_glossy_pairs(n);
  see_plastics();
}

void WidePixelGroups::see_plastics() {
  for (const Shared& s : shared_) {
    const int list = second_.list[s.place], n = s.group.size;
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

void WidePixelGroups::evaluate_glossy_pairs(int n) {
  for (std::vector<int>& list : glossy_pairs_) list.clear();
  for (int k = 0; k < n; ++k) {
    const int list = first_.list[pairs_.first[k]];
    if (list > 0 && pairs_.geometry[k] > 0) glossy_pairs_[size_t(list - 1)].push_back(k);
  }
  const WideVertices all{first_.paths, first_.points, numbers_};
  for (size_t number = 0; number < glossy_pairs_.size(); ++number) {
    const std::vector<int>& list = glossy_pairs_[number];
    if (list.empty()) continue;
    const int count = int(list.size());
    for (int k = 0; k < count; ++k) {
      glossy_.at[k] = pairs_.first[list[size_t(k)]];
      glossy_.towards.set(k, pairs_.direction.vector(list[size_t(k)]));
    }
    std::visit([&](const auto& material) { evaluate_glossy(count, material, all, glossy_); },
               wide_.glossy[number]);
    for (int k = 0; k < count; ++k) {
      const int pair = list[size_t(k)];
      const float geometry = pairs_.geometry[pair];
      const Vector3f value = glossy_.value.vector(k);
      // Where nothing is carried no path goes on.
      pairs_.pdf[pair] = max_abs(value) > 0 ? glossy_.value_pdf[k] * geometry : 0.0f;
      pairs_.value.set(pair, value * geometry);
    }
  }
}

void WidePixelGroups::drop_two_sided(int n) {
  for (int k = 0; k < n; ++k) {
    const int i = pairs_.first[k];
    if (sides_differ(first_.points.ng.vector(i), first_.points.ns.vector(i),
                     pairs_.direction.vector(k)))
      pairs_.pdf[k] = 0;
  }
}

void WidePixelGroups::test(int n, RenderCounters& counters) {
  if (strict_normals_) drop_two_sided(n);
  int rays = 0;
  // Without branches: which pairs have a density cannot be predicted.
  for (int k = 0; k < n; ++k) {
    shadows_.ray.origin.set(rays, pairs_.ray.origin.point(k));
    shadows_.ray.direction.set(rays, pairs_.ray.direction.vector(k));
    shadows_.ray.tmax[rays] = 0x1.fffep-1f;
    shadows_.blocked[rays] = 0;
    shadows_.id[rays] = k;
    // What its own path has found is seen.
    rays += int(pairs_.pdf[k] > 0) & int(pairs_.first[k] != pairs_.second[k]);
  }
  wide_.scene.accel->occluded(shadows_.ray, rays, shadows_.blocked);
  counters.shadow_rays += uint64_t(rays);
  for (int r = 0; r < rays; ++r)
    if (shadows_.blocked[r]) pairs_.pdf[shadows_.id[r]] = 0;
}

void WidePixelGroups::give_sums(WideSamples& samples) const {
  for (int k = 0; k < count_; ++k) samples.add(pixel_[size_t(k)], color_at(sums_, k));
}

}  // namespace duet
