// Filters whose effect on polarisation is not seen.
#include "mitsuba/plugins/bsdf.h"
#include "mitsuba/plugins/bsdfs.h"

namespace duet::plugins {

namespace {

template <FilterKindOfLight kKind>
void read_filter_of_light(SceneReader& s, Properties& p, MaterialDescription& out) {
  FilterMaterial m{.kind = kKind};
  read_values(s, p, m);
  s.report().warning(p.node().where, "{} sees light without polarisation: it {}",
                     describe(p.node()),
                     m.kind == FilterKindOfLight::retarder ? "changes only its intensity"
                                                           : "lets half of it pass");
  out.model = m;
}

template <FilterKindOfLight kKind>
Plugin filter_of_light(std::span<const Parameter> parameters) {
  return {.name = FilterMaterial::kKinds[size_t(kKind)],
          .versions = v3,
          .parameters = parameters,
          .reader = &read_filter_of_light<kKind>,
          .note = "for light without polarisation, with a warning"};
}

constexpr Parameter kTransmittance = parameter_of<FilterMaterial>("transmittance");
constexpr Parameter kTheta{.name = "theta", .type = number_or_texture, .support = inert};
constexpr Parameter kPolarizer[] = {
    kTransmittance,
    kTheta,
    {.name = "polarizing", .type = boolean, .note = "either way half passes", .support = inert}};
constexpr Parameter kRetarder[] = {
    kTransmittance, kTheta, {.name = "delta", .type = number_or_texture, .support = inert}};
constexpr Parameter kCircular[] = {
    kTransmittance, kTheta, {.name = "left_handed", .type = boolean, .support = inert}};

}  // namespace

Plugin circular() {
  return filter_of_light<FilterKindOfLight::circular>(kCircular);
}

Plugin polarizer() {
  return filter_of_light<FilterKindOfLight::polarizer>(kPolarizer);
}

Plugin retarder() {
  return filter_of_light<FilterKindOfLight::retarder>(kRetarder);
}

}  // namespace duet::plugins
