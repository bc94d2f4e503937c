#include "materials/bsdf.h"

namespace duet {

namespace {

constexpr float kBelowOne = 0x1.fffffep-1f;

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

ModelEval eval_tilted(const BsdfComponent& c, const Tilt& tilt, const Vector3f& wo,
                      const Vector3f& wi, Transport transport) {
  const bool to_light = transport == Transport::radiance;
  const Vector3f& eye = to_light ? wo : wi;
  const Vector3f& light = to_light ? wi : wo;
  const bool turned = tilt.turned_for(eye);
  const Vector3f o = tilt.to_local(wo, turned), i = tilt.to_local(wi, turned);
  if (!tilt.agrees(light, to_light ? i : o)) return {};
  ModelEval e = eval_model(c, on_side(o, c.side), on_side(i, c.side), transport);
  e.value *= tilt.shadowing(light);
  if (to_light) return e;
  e.value *= cosine_exchange(light, o, eye, i);
  // The sampler had to guess for which eye the normal is turned.
  const float p = tilt.turned_probability();
  if (p > 0) {
    const Vector3f o2 = tilt.to_local(wo, !turned), i2 = tilt.to_local(wi, !turned);
    const float other = eval_model(c, on_side(o2, c.side), on_side(i2, c.side), transport).pdf;
    const float q = turned ? p : 1 - p;
    e.pdf = q * e.pdf + (1 - q) * other;
  }
  return e;
}

std::optional<ModelSample> sample_tilted(const BsdfComponent& c, const Tilt& tilt,
                                         const Vector3f& wo, float u, const Point2f& v,
                                         Transport transport) {
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
  auto s = sample_model(c, on_side(o, c.side), u, v, transport);
  if (!s) return std::nullopt;
  const Vector3f i = on_side(s->wi, c.side);
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
  const ModelEval e = eval_tilted(c, tilt, wo, s->wi, transport);
  if (!(e.pdf > 0)) return std::nullopt;
  s->weight = e.value / e.pdf;
  s->pdf = e.pdf;
  return s;
}

/// Directions in the shading frame.
ModelEval eval_component(const BsdfComponent& c, const Tilt* tilts, const Vector3f& wo,
                         const Vector3f& wi, Transport transport) {
  if (c.tilt >= 0) [[unlikely]]
    return eval_tilted(c, tilts[c.tilt], wo, wi, transport);
  return eval_model(c, on_side(wo, c.side), on_side(wi, c.side), transport);
}

std::optional<ModelSample> sample_component(const BsdfComponent& c, const Tilt* tilts,
                                            const Vector3f& wo, float u, const Point2f& v,
                                            Transport transport) {
  if (c.tilt >= 0) [[unlikely]]
    return sample_tilted(c, tilts[c.tilt], wo, u, v, transport);
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
    const ModelEval e = eval_component(components_[i], tilts_, wo_, wi, transport);
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
    if (c.kind == ModelKind::null) sum += Spectrum(c.share);
    if (c.kind != ModelKind::thin_dielectric) continue;
    const Vector3f wo =
        c.tilt < 0 ? wo_ : tilts_[c.tilt].to_local(wo_, tilts_[c.tilt].turned_for(wo_));
    sum += c.model.thin_dielectric.straight_through(wo) * c.share;
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
    sum.value += eval_component(components_[i], tilts_, wi, wo_, opposite(transport)).pdf *
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
  const auto s = sample_component(c, tilts_, wo_, u, v, transport);
  if (!s) return out;
  const Vector3f wi = c.tilt >= 0 ? s->wi : on_side(s->wi, c.side);
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
    const ModelEval e = eval_component(components_[i], tilts_, wo_, wi, transport);
    value += e.value * components_[i].share;
    out->pdf.value += e.pdf * components_[i].share;
  }
  out->weight = value / out->pdf.value;
  return out;
}

}  // namespace duet
