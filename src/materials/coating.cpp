#include "materials/coating.h"

namespace duet {

namespace {

/// Probability of looking at the coat's own reflection. The same from all directions, as sub-paths
/// from both ends need it.
constexpr float kReflectionShare = 0.25f;

std::optional<RoughTransmittance> make_tables(const CoatingOptions& o) {
  if (!o.roughness) return std::nullopt;
  const RoughnessOptions& r = *o.roughness;
  return r.alpha_u.is_constant() ? RoughTransmittance(r.distribution, o.eta, r.alpha_u.constant)
                                 : RoughTransmittance(r.distribution, o.eta);
}

}  // namespace

Coating::Coating(const CoatingOptions& options, const Material& nested)
    : options_(options), nested_(nested), tables_(make_tables(options)) {
  if (options_.roughness) options_.roughness->alpha_v = options_.roughness->alpha_u;
}

SurfaceNeeds Coating::needs() const {
  const SurfaceNeeds own{.uv = any_needs_uv(options_.sigma_a, options_.specular_reflectance)};
  return nested_.needs() | own |
         (options_.roughness ? options_.roughness->needs() : SurfaceNeeds{});
}

void Coating::add_components(const Surface& s, BsdfBuilder& builder) const {
  const Spectrum specular = options_.specular_reflectance(s) * (1 / kReflectionShare);
  const Spectrum absorption = options_.sigma_a(s) * options_.thickness;
  constexpr float kCompensation = 1 / (1 - kReflectionShare);
  Coat coat(options_.eta, absorption, kCompensation);
  builder.with_share(kReflectionShare, [&](BsdfBuilder& b) {
    if (!options_.roughness) return b.add(CoatReflectionModel{options_.eta, specular});
    const float alpha = options_.roughness->alpha_u(s);
    const TransmittanceRow row = (*tables_)(alpha).external;
    coat = Coat(options_.eta, absorption, kCompensation, row);
    const RoughPlasticModel interface {
      (*options_.roughness)(s), options_.eta, specular, Spectrum(0), 1, 0, row
    };
    if (b.wo().z >= 0) return b.add(interface);
    b.flipped([&](BsdfBuilder& below) { below.add(interface); });
  });
  builder.with_share(1 - kReflectionShare, [&](BsdfBuilder& b) {
    b.coated(coat, [&](BsdfBuilder& below) { nested_.bind(s, below); });
  });
}

}  // namespace duet
