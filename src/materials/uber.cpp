#include "materials/pbrt_materials.h"

namespace duet {

namespace {

Spectrum color_at(const ColorSlot& slot, const Surface& s) {
  const Spectrum c = slot(s);
  return {std::clamp(c.r, 0.0f, 1.0f), std::clamp(c.g, 0.0f, 1.0f), std::clamp(c.b, 0.0f, 1.0f)};
}

bool is_constantly(const ColorSlot& slot, float value) {
  return slot.is_constant() && slot.constant == Spectrum(value);
}

/// How often a lobe is sampled that scatters the share `weight` of the light, before the shares are
/// made to sum to one: faint lobes are not left out. Zero for what is black.
float choice(float weight) {
  return weight > 0 ? weight + 0.05f : 0.0f;
}

}  // namespace

SurfaceNeeds Uber::needs() const {
  const UberOptions& o = options_;
  return o.roughness.needs() |
         SurfaceNeeds{.uv = any_needs_uv(o.diffuse_reflectance, o.diffuse_transmittance,
                                         o.glossy_reflectance, o.glossy_transmittance,
                                         o.specular_reflectance, o.specular_transmittance,
                                         o.opacity, o.eta)};
}

bool Uber::transmits() const {
  const UberOptions& o = options_;
  return passes_straight() ||
         !(is_constantly(o.diffuse_transmittance, 0) && is_constantly(o.glossy_transmittance, 0) &&
           is_constantly(o.specular_transmittance, 0));
}

bool Uber::passes_straight() const {
  return !is_constantly(options_.opacity, 1);
}

Spectrum Uber::local_albedo(const Surface& s, const Vector3f&) const {
  const UberOptions& o = options_;
  return color_at(o.opacity, s) *
         (color_at(o.diffuse_reflectance, s) + color_at(o.diffuse_transmittance, s));
}

void Uber::add_components(const Surface& s, BsdfBuilder& builder) const {
  const UberOptions& o = options_;
  const Spectrum opacity = color_at(o.opacity, s);
  const auto color = [&](const ColorSlot& slot) { return opacity * color_at(slot, s); };
  const Spectrum dr = color(o.diffuse_reflectance), dt = color(o.diffuse_transmittance);
  const Spectrum gr = color(o.glossy_reflectance), gt = color(o.glossy_transmittance);
  const Spectrum sr = color(o.specular_reflectance), st = color(o.specular_transmittance);
  const Spectrum passed = Spectrum(1) - opacity;
  // A dielectric interface reflects little of diffuse light. Shares are the same for all
  // directions, as sub-paths from both ends need it.
  constexpr float kReflected = 0.2f;
  const auto interface = [](const Spectrum& r, const Spectrum& t) {
    return choice(kReflected * r.mean() + (1 - kReflected) * t.mean());
  };
  const float diffuse = choice(dr.mean() + dt.mean()), glossy = interface(gr, gt),
              specular = interface(sr, st), straight = choice(passed.mean());
  const float all = diffuse + glossy + specular + straight;
  if (!(all > 0)) return;
  const float eta = std::clamp(o.eta(s), 1e-2f, 1e2f);
  // Each component is weighted by its share, which its colours make up for.
  builder.with_share(diffuse / all, [&](BsdfBuilder& b) {
    const float scale = all / diffuse;
    b.add(DiffuseTransmitterModel{dt * scale, dr * scale});
  });
  builder.with_share(glossy / all, [&](BsdfBuilder& b) {
    const float scale = all / glossy;
    const RoughDielectricModel interface_model{o.roughness(s), eta, gr * scale, gt * scale};
    // A surface that nothing passes is the same from both sides.
    if (b.wo().z < 0 && gt.is_black())
      b.flipped([&](BsdfBuilder& below) { below.add(interface_model); });
    else
      b.add(interface_model);
  });
  builder.with_share(specular / all, [&](BsdfBuilder& b) {
    const float scale = all / specular;
    b.add(DielectricModel{eta, sr * scale, st * scale});
  });
  builder.with_share(straight / all,
                     [&](BsdfBuilder& b) { b.add(FilterModel{passed * (all / straight)}); });
}

}  // namespace duet
