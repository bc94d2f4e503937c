#include "materials/layer_walk.h"

#include "materials/conductor.h"
#include "materials/dielectric.h"
#include "materials/diffuse.h"
#include "materials/henyey_greenstein.h"

namespace duet {

namespace {

/// Walks are ended at random from this event on, once they carry less than this.
constexpr int kSureEvents = 4;
constexpr float kLittle = 0.25f;

/// Directions along the layer would never leave it.
bool is_level(const Vector3f& w) {
  return !(std::abs(w.z) > kMinCosine);
}

float passing(float distance, const Vector3f& w) {
  return std::exp(-distance / std::abs(w.z));
}

/// Calls f(model) with the coat as an interface that only lets pass, or only reflects.
template <class F>
auto with_coat(const LayeredModel& m, float reflects, F&& f) {
  const Spectrum r(reflects), t(1 - reflects);
  return m.smooth_coat ? f(DielectricModel{m.eta, r, t})
                       : f(RoughDielectricModel{m.coat, m.eta, r, t});
}

template <class F>
auto with_base(const LayeredModel& m, F&& f) {
  if (!m.is_metal) return f(DiffuseModel{m.base});
  if (m.smooth_base) return f(ConductorModel{m.base, m.base_k, Spectrum(1)});
  return f(RoughConductorModel{m.metal, m.base, m.base_k, Spectrum(1), false});
}

}  // namespace

Point2f LayerWalk::next_2d() {
  const float x = next();
  return {x, next()};
}

LayerWalk::Entered LayerWalk::enter(const Vector3f& w) {
  const Point2f v = next_2d();
  const auto s = with_coat(
      m_, 0, [&](const auto& coat) { return coat.sample(w, 0.5f, v, Transport::importance); });
  if (!s || is_level(s->wi)) return {{}, 0, 0, false, false};
  return {s->wi, s->weight.r, s->pdf, true, s->delta};
}

Spectrum LayerWalk::estimate(const Vector3f& from, const Vector3f& to) {
  to_ = to;
  sum_ = {};
  const Entered entered = enter(from);
  light_ = enter(to);
  if (!entered.exists) return {};
  w_ = entered.direction;
  beta_ = Spectrum(entered.weight);
  depth_ = 0;
  for (int event = 0; event < m_.max_depth; ++event) {
    if (event >= kSureEvents && beta_.max() < kLittle) {
      const float p = beta_.max();
      if (!(next() < p)) break;
      beta_ *= 1 / p;
    }
    if (m_.scatters()) {
      const float way = -std::log(1 - next()) * w_.z;
      const float depth = depth_ - way;
      if (depth > 0 && depth < m_.thickness) {
        depth_ = depth;
        if (!in_layer(event)) break;
        continue;
      }
    } else {
      beta_ *= passing(m_.thickness, w_);
    }
    if (!(w_.z < 0 ? at_base() : at_coat())) break;
  }
  return sum_;
}

bool LayerWalk::at_base() {
  depth_ = m_.thickness;
  return with_base(m_, [&](const auto& base) {
    if (light_.exists && base.has_smooth()) {
      const ModelEval e = base.eval(-w_, -light_.direction, Transport::radiance);
      const float share = light_.delta ? 1 : light_.pdf / (light_.pdf + e.pdf);
      sum_ += beta_ * e.value *
              (share * light_.weight * passing(m_.thickness, light_.direction) /
               std::abs(light_.direction.z));
    }
    const Point2f v = next_2d();
    const auto s = base.sample(-w_, 0, v, Transport::radiance);
    if (!s || is_level(s->wi)) return false;
    beta_ *= s->weight;
    w_ = s->wi;
    leave(s->delta ? 0 : s->pdf);
    return true;
  });
}

bool LayerWalk::at_coat() {
  depth_ = 0;
  const Point2f v = next_2d();
  const auto s = with_coat(
      m_, 1, [&](const auto& coat) { return coat.sample(-w_, 0.5f, v, Transport::importance); });
  if (!s || is_level(s->wi)) return false;
  beta_ *= s->weight;
  w_ = s->wi;
  return true;
}

bool LayerWalk::in_layer(int event) {
  sum_ += beta_ * m_.albedo * light_at(event);
  const Vector3f w = sample_henyey_greenstein(w_, m_.g, next_2d());
  if (is_level(w)) return false;
  const float pdf = henyey_greenstein(dot(w_, w), m_.g);
  beta_ *= m_.albedo;
  w_ = w;
  if (w_.z > 0) leave(pdf);
  return true;
}

Spectrum LayerWalk::light_at(int event) const {
  if (!light_.exists) return {};
  Vector3f w = light_.direction;
  const float cosine = std::abs(w.z), crossing = passing(m_.thickness, w);
  Spectrum carried(light_.weight / cosine), sum;
  for (; event < m_.max_depth; ++event) {
    const float phase = henyey_greenstein(-dot(w, w_), m_.g);
    const float share = light_.delta ? 1 : light_.pdf / (light_.pdf + phase);
    sum += carried * (share * phase * passing(w.z < 0 ? depth_ : m_.thickness - depth_, w));
    if (!m_.is_mirror()) break;
    carried *= w.z < 0 ? fresnel_conductor(cosine, m_.base, m_.base_k)
                       : Spectrum(fresnel_dielectric(cosine, 1 / m_.eta).reflectance);
    carried *= crossing;
    w.z = -w.z;
  }
  return sum;
}

void LayerWalk::leave(float pdf) {
  if (m_.smooth_coat) return;
  const ModelEval e = with_coat(
      m_, 0, [&](const auto& coat) { return coat.eval(to_, -w_, Transport::importance); });
  if (!(e.pdf > 0)) return;
  const float share = pdf > 0 ? pdf / (pdf + e.pdf) : 1.0f;
  sum_ += beta_ * (share * e.value.r * passing(depth_, w_) / w_.z);
}

}  // namespace duet
