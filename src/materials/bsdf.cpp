#include "materials/bsdf.h"

#include "math/warp.h"

namespace duet {

namespace {

Transport opposite(Transport t) {
  return t == Transport::radiance ? Transport::importance : Transport::radiance;
}

Vector3f on_side(const Vector3f& w, float side) {
  return {w.x, w.y, w.z * side};
}

ModelEval eval_model(const BsdfComponent& c, const Vector3f& wo, const Vector3f& wi,
                     Transport transport) {
  return visit_model(c, [&](const auto& model) { return model.eval(wo, wi, transport); });
}

/// Without the value, where that takes much work.
float density_of_model(const BsdfComponent& c, const Vector3f& wo, const Vector3f& wi,
                       Transport transport) {
  return visit_model(c, [&](const auto& model) {
    if constexpr (requires { model.density(wo, wi); })
      return model.density(wo, wi);
    else
      return model.eval(wo, wi, transport).pdf;
  });
}

std::optional<ModelSample> sample_model(const BsdfComponent& c, const Vector3f& wo, float u,
                                        const Point2f& v, Transport transport) {
  return visit_model(c, [&](const auto& model) { return model.sample(wo, u, v, transport); });
}

/// The factor by which the value of importance sent from `light` to `eye` changes when the cosines
/// of a tilted frame are exchanged for those of the surface's own: see Bsdf.
float cosine_exchange(const Vector3f& light, const Vector3f& local_light, const Vector3f& eye,
                      const Vector3f& local_eye) {
  const float from = std::abs(light.z * local_eye.z);
  return from > 0 ? std::abs(local_light.z * eye.z) / from : 0.0f;
}

/// What is left of a component below the first `level` of its covers, in the frame that these make.
struct Covered {
  const BsdfComponent& component;
  const Cover* covers;
  int level;
  bool has_cover() const { return level < kMaxCovers && component.covers[level] >= 0; }
  const Cover& cover() const { return covers[component.covers[level]]; }
  Covered below() const { return {component, covers, level + 1}; }
};

ModelEval eval_below(const Covered& c, const Vector3f& wo, const Vector3f& wi, Transport transport);
std::optional<ModelSample> sample_below(const Covered& c, const Vector3f& wo, float u,
                                        const Point2f& v, Transport transport);

ModelEval eval_tilted(const Covered& c, const Vector3f& wo, const Vector3f& wi,
                      Transport transport) {
  const Tilt& tilt = c.cover().tilt;
  const bool to_light = transport == Transport::radiance;
  const Vector3f& eye = to_light ? wo : wi;
  const Vector3f& light = to_light ? wi : wo;
  const bool turned = tilt.turned_for(eye);
  const Vector3f o = tilt.to_local(wo, turned), i = tilt.to_local(wi, turned);
  if (!tilt.agrees(light, to_light ? i : o)) return {};
  ModelEval e = eval_below(c.below(), o, i, transport);
  e.value *= tilt.shadowing(light);
  if (to_light) return e;
  e.value *= cosine_exchange(light, o, eye, i);
  // The sampler had to guess for which eye the normal is turned.
  const float p = tilt.turned_probability();
  if (p > 0) {
    const Vector3f o2 = tilt.to_local(wo, !turned), i2 = tilt.to_local(wi, !turned);
    const float other = eval_below(c.below(), o2, i2, transport).pdf;
    const float q = turned ? p : 1 - p;
    e.pdf = q * e.pdf + (1 - q) * other;
  }
  return e;
}

std::optional<ModelSample> sample_tilted(const Covered& c, const Vector3f& wo, float u,
                                         const Point2f& v, Transport transport) {
  const Tilt& tilt = c.cover().tilt;
  const bool to_light = transport == Transport::radiance;
  bool turned = false;
  float probability = 1;
  if (to_light) {
    turned = tilt.turned_for(wo);
  } else if (const float p = tilt.turned_probability(); p > 0) {
    turned = u < p;
    probability = turned ? p : 1 - p;
    u = std::min((turned ? u : u - p) / probability, kBelowOne);
  }
  const Vector3f o = tilt.to_local(wo, turned);
  auto s = sample_below(c.below(), o, u, v, transport);
  if (!s) return std::nullopt;
  const Vector3f i = s->wi;
  s->wi = tilt.from_local(i, turned);
  const Vector3f& eye = to_light ? wo : s->wi;
  const Vector3f& light = to_light ? s->wi : wo;
  if (to_light || s->delta) {
    if (tilt.turned_for(eye) != turned || !tilt.agrees(light, to_light ? i : o))
      return std::nullopt;
    s->weight *= tilt.shadowing(light);
    if (to_light) return s;
    s->weight *= cosine_exchange(light, o, eye, i) / probability;
    s->pdf *= probability;
    return s;
  }
  const ModelEval e = eval_tilted(c, wo, s->wi, transport);
  if (!(e.pdf > 0)) return std::nullopt;
  s->weight = e.value / e.pdf;
  s->pdf = e.pdf;
  return s;
}

ModelEval eval_coated(const Covered& c, const Vector3f& wo, const Vector3f& wi,
                      Transport transport) {
  const Coat& coat = c.cover().coat;
  if (wo.z == 0 || wi.z == 0) return {};
  const Vector3f o = coat.inside(wo), i = coat.inside(wi);
  ModelEval e = eval_below(c.below(), o, i, transport);
  const float compression = coat.compression(wi, i);
  e.value *= coat.transmittance(wo, o, wi, i) * compression;
  e.pdf *= compression;
  return e;
}

std::optional<ModelSample> sample_coated(const Covered& c, const Vector3f& wo, float u,
                                         const Point2f& v, Transport transport) {
  const Coat& coat = c.cover().coat;
  if (wo.z == 0) return std::nullopt;
  const Vector3f o = coat.inside(wo);
  auto s = sample_below(c.below(), o, u, v, transport);
  if (!s) return std::nullopt;
  const Vector3f i = s->wi;
  if (!coat.outside(i, s->wi)) return std::nullopt;
  s->weight *= coat.transmittance(wo, o, s->wi, i);
  if (!s->delta) s->pdf *= coat.compression(s->wi, i);
  // A coat is a surface for shadow rays.
  s->null = false;
  return s;
}

ModelEval eval_below(const Covered& c, const Vector3f& wo, const Vector3f& wi,
                     Transport transport) {
  const BsdfComponent& bare = c.component;
  if (!c.has_cover())
    return eval_model(bare, on_side(wo, bare.side), on_side(wi, bare.side), transport);
  return c.cover().is_coat ? eval_coated(c, wo, wi, transport) : eval_tilted(c, wo, wi, transport);
}

std::optional<ModelSample> sample_below(const Covered& c, const Vector3f& wo, float u,
                                        const Point2f& v, Transport transport) {
  if (!c.has_cover()) {
    const BsdfComponent& bare = c.component;
    auto s = sample_model(bare, on_side(wo, bare.side), u, v, transport);
    if (s) s->wi = on_side(s->wi, bare.side);
    return s;
  }
  return c.cover().is_coat ? sample_coated(c, wo, u, v, transport)
                           : sample_tilted(c, wo, u, v, transport);
}

/// Directions in the shading frame.
ModelEval eval_component(const BsdfComponent& c, const Cover* covers, const Vector3f& wo,
                         const Vector3f& wi, Transport transport) {
  if (c.covers[0] >= 0) [[unlikely]]
    return eval_below({c, covers, 0}, wo, wi, transport);
  return eval_model(c, on_side(wo, c.side), on_side(wi, c.side), transport);
}

float component_density(const BsdfComponent& c, const Cover* covers, const Vector3f& wo,
                        const Vector3f& wi, Transport transport) {
  if (c.covers[0] >= 0) [[unlikely]]
    return eval_below({c, covers, 0}, wo, wi, transport).pdf;
  return density_of_model(c, on_side(wo, c.side), on_side(wi, c.side), transport);
}

std::optional<ModelSample> sample_component(const BsdfComponent& c, const Cover* covers,
                                            const Vector3f& wo, float u, const Point2f& v,
                                            Transport transport) {
  if (c.covers[0] >= 0) [[unlikely]]
    return sample_below({c, covers, 0}, wo, u, v, transport);
  return sample_model(c, on_side(wo, c.side), u, v, transport);
}

}  // namespace

// What most vertices need is kept apart from the rest, so that it does not pay for the registers
// and the stack of all models.

BsdfEval Bsdf::eval(const Vector3f& wi_world, Transport transport) const {
  const Vector3f wi = frame_.to_local(wi_world);
  if (is_plain_diffuse()) [[likely]] {
    const BsdfComponent& c = components_[0];
    const ModelEval e = c.model.diffuse.eval(on_side(wo_, c.side), on_side(wi, c.side), transport);
    return {e.value * c.share, PdfW{e.pdf * c.share}};
  }
  return eval_all(wi, transport);
}

std::optional<BsdfSample> Bsdf::sample(float u, const Point2f& v, Transport transport) const {
  if (is_plain_diffuse() && components_[0].share == 1) [[likely]] {
    const BsdfComponent& c = components_[0];
    const auto s = c.model.diffuse.sample(on_side(wo_, c.side), u, v, transport);
    if (!s) return std::nullopt;
    return BsdfSample{frame_.to_world(on_side(s->wi, c.side)), s->weight, PdfW{s->pdf}};
  }
  return sample_all(u, v, transport);
}

[[gnu::noinline]] BsdfEval Bsdf::eval_all(const Vector3f& wi, Transport transport) const {
  BsdfEval sum{};
  for (int i = 0; i < count_; ++i) {
    const ModelEval e = eval_component(components_[i], covers_, wo_, wi, transport);
    sum.value += e.value * components_[i].share;
    sum.pdf.value += e.pdf * components_[i].share;
  }
  return sum;
}

BsdfPair Bsdf::eval_both_ways(const Vector3f& wi_world, Transport transport) const {
  const Vector3f wi = frame_.to_local(wi_world);
  if (is_plain_diffuse()) [[likely]] {
    const BsdfComponent& c = components_[0];
    const ModelEval e = c.model.diffuse.eval(on_side(wo_, c.side), on_side(wi, c.side), transport);
    // The other way round the cosines change places.
    return {e.value * c.share, PdfW{e.pdf * c.share}, PdfW{std::abs(wo_.z) * kInvPi * c.share}};
  }
  const BsdfEval e = eval_all(wi, transport);
  if (e.value.is_black()) return {};
  return {e.value, e.pdf, reverse_pdf_all(wi, transport)};
}

Spectrum Bsdf::straight_through() const {
  Spectrum sum;
  for (int i = 0; i < count_; ++i) {
    const BsdfComponent& c = components_[i];
    Vector3f wo = wo_;
    bool coated = false;
    for (int l = 0; l < kMaxCovers && c.covers[l] >= 0; ++l) {
      const Cover& cover = covers_[c.covers[l]];
      coated |= cover.is_coat;
      if (!cover.is_coat) wo = cover.tilt.to_local(wo, cover.tilt.turned_for(wo));
    }
    if (coated) continue;
    if (c.kind == ModelKind::null) sum += Spectrum(c.share);
    if (c.kind == ModelKind::filter) sum += c.model.filter.transmittance * c.share;
    if (c.kind == ModelKind::thin_dielectric)
      sum += c.model.thin_dielectric.straight_through(wo) * c.share;
    if (c.kind == ModelKind::thin_layer) sum += c.model.thin_layer.straight_through(wo) * c.share;
  }
  return sum;
}

PdfW Bsdf::reverse_pdf(const Vector3f& wi_world, Transport transport) const {
  const Vector3f wi = frame_.to_local(wi_world);
  if (is_plain_diffuse()) [[likely]] {
    const BsdfComponent& c = components_[0];
    const ModelEval e =
        c.model.diffuse.eval(on_side(wi, c.side), on_side(wo_, c.side), opposite(transport));
    return PdfW{e.pdf * c.share};
  }
  return reverse_pdf_all(wi, transport);
}

[[gnu::noinline]] PdfW Bsdf::reverse_pdf_all(const Vector3f& wi, Transport transport) const {
  PdfW sum;
  for (int i = 0; i < count_; ++i)
    sum.value += component_density(components_[i], covers_, wi, wo_, opposite(transport)) *
                 components_[i].share;
  return sum;
}

[[gnu::noinline]] std::optional<BsdfSample> Bsdf::sample_all(float u, const Point2f& v,
                                                             Transport transport) const {
  std::optional<BsdfSample> out;
  int pick = 0;
  while (pick < count_ && u >= components_[pick].share) u -= components_[pick++].share;
  if (pick == count_) return out;
  const BsdfComponent& c = components_[pick];
  u = std::min(u / c.share, kBelowOne);
  const auto s = sample_component(c, covers_, wo_, u, v, transport);
  if (!s) return out;
  const Vector3f wi = c.covers[0] >= 0 ? s->wi : on_side(s->wi, c.side);
  out.emplace();
  out->wi = frame_.to_world(wi);
  out->weight = s->weight;
  out->pdf.value = s->pdf * c.share;
  out->eta = s->eta;
  out->delta = s->delta;
  out->null = s->null;
  if (count_ == 1 || s->delta) return out;
  // The other components could have made the same direction.
  Spectrum value = s->weight * out->pdf.value;
  for (int i = 0; i < count_; ++i) {
    if (i == pick) continue;
    const ModelEval e = eval_component(components_[i], covers_, wo_, wi, transport);
    value += e.value * components_[i].share;
    out->pdf.value += e.pdf * components_[i].share;
  }
  out->weight = value / out->pdf.value;
  return out;
}

}  // namespace duet
