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

/// `own` is the parameter of its effect on polarised light.
template <FilterKindOfLight kKind>
Plugin filter_of_light(const Parameter& own) {
  return {.name = FilterMaterial::kKinds[size_t(kKind)],
          .versions = v3,
          .parameters = {parameters_of<FilterMaterial>(),
                         inert_parameters(number_or_texture, "theta"), own},
          .reader = &read_filter_of_light<kKind>,
          .note = "for light without polarisation, with a warning"};
}

}  // namespace

Plugin circular() {
  return filter_of_light<FilterKindOfLight::circular>(
      {.name = "left_handed", .type = boolean, .support = inert});
}

Plugin polarizer() {
  return filter_of_light<FilterKindOfLight::polarizer>(
      {.name = "polarizing", .type = boolean, .note = "either way half passes", .support = inert});
}

Plugin retarder() {
  return filter_of_light<FilterKindOfLight::retarder>(
      {.name = "delta", .type = number_or_texture, .support = inert});
}

}  // namespace duet::plugins
