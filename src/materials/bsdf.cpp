#include "materials/bsdf.h"

namespace duet {

void BsdfBuilder::flip() {
  side_ = -side_;
  wo_.z = -wo_.z;
  if (perturbed_) frame_.n = -frame_.n;
}

void BsdfBuilder::perturb(const Frame& frame) {
  if (!perturbed_) {
    // The frame so far is the shading frame, mirrored or not.
    frame_ = Frame({1, 0, 0}, {0, 1, 0}, {0, 0, side_});
    perturbed_ = true;
  }
  wo_ = frame.to_local(wo_);
  const Frame outer = frame_;
  frame_.s = outer.to_world(frame.s);
  frame_.t = outer.to_world(frame.t);
  frame_.n = Normal3f(outer.to_world(Vector3f(frame.n)));
}

Vector3f Bsdf::to_model(int i, const Vector3f& w) const {
  if (components_[i].perturbed) [[unlikely]]
    return frames_[i].to_local(w);
  return {w.x, w.y, w.z * components_[i].side};
}

Vector3f Bsdf::from_model(int i, const Vector3f& w) const {
  if (components_[i].perturbed) [[unlikely]]
    return frames_[i].to_world(w);
  return {w.x, w.y, w.z * components_[i].side};
}

bool Bsdf::is_consistent(int i, const Vector3f& shading, const Vector3f& model) const {
  return !components_[i].perturbed || shading.z * components_[i].side * model.z > 0;
}

ModelEval Bsdf::eval_component(int i, const Vector3f& wi, Transport transport) const {
  const Vector3f o = to_model(i, wo_), m = to_model(i, wi);
  if (!is_consistent(i, wi, m)) return {};
  return visit_model(components_[i], [&](const auto& x) { return x.eval(o, m, transport); });
}

BsdfEval Bsdf::eval(const Vector3f& wi_world, Transport transport) const {
  const Vector3f wi = frame_.to_local(wi_world);
  BsdfEval sum{};
  for (int i = 0; i < count_; ++i) {
    const ModelEval e = eval_component(i, wi, transport);
    sum.value += e.value * components_[i].share;
    sum.pdf.value += e.pdf * components_[i].share;
  }
  return sum;
}

std::optional<BsdfSample> Bsdf::sample(float u, const Point2f& v, Transport transport) const {
  int pick = 0;
  while (pick < count_ && u >= components_[pick].share) u -= components_[pick++].share;
  if (pick == count_) return std::nullopt;
  const BsdfComponent& c = components_[pick];
  u = std::min(u / c.share, 0x1.fffffep-1f);
  const Vector3f wo = to_model(pick, wo_);
  const auto s = visit_model(c, [&](const auto& x) { return x.sample(wo, u, v, transport); });
  if (!s) return std::nullopt;
  const Vector3f wi = from_model(pick, s->wi);
  if (!is_consistent(pick, wi, s->wi)) return std::nullopt;
  BsdfSample out{frame_.to_world(wi),      s->weight, PdfW{s->pdf * c.share}, s->eta, s->delta,
                 c.kind == ModelKind::null};
  if (count_ == 1 || s->delta) return out;
  // The other components could have made the same direction.
  Spectrum value = s->weight * (s->pdf * c.share);
  for (int i = 0; i < count_; ++i) {
    if (i == pick) continue;
    const ModelEval e = eval_component(i, wi, transport);
    value += e.value * components_[i].share;
    out.pdf.value += e.pdf * components_[i].share;
  }
  out.weight = value / out.pdf.value;
  return out;
}

}  // namespace duet
