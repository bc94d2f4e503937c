// Metals by name, and indices relative to the outside.
#include "mitsuba/plugins/bsdf.h"
#include "mitsuba/plugins/bsdfs.h"
#include "values/ior.h"
#include "values/text.h"

namespace duet::plugins {

namespace {

void divide(ColorInput& color, double divisor) {
  if (Spectrum* constant = std::get_if<Spectrum>(&color))
    *constant = {float(double(constant->r) / divisor), float(double(constant->g) / divisor),
                 float(double(constant->b) / divisor)};
}

void read_conductor(SceneReader& s, Properties& p, MaterialDescription& out) {
  ConductorMaterial m;
  const bool has_index = p.has("eta") || p.has("k");
  if (p.has("material") && has_index && !p.is_0x())
    p.error("material", "either \"material\" or \"eta\" and \"k\" can be given");
  const std::string name =
      p.has("material") || p.is_0x() || !has_index ? p.string("material") : "none";
  bool mirror = to_lower(name) == "none";
  if (const ConductorEntry* entry = find_conductor(name)) {
    m.eta = entry->eta;
    m.k = entry->k;
  } else if (!mirror) {
    p.error("material", "no metal is called {}{}", in_quotes(name),
            did_you_mean(name, conductor_names()));
  }
  if (p.has("eta")) m.eta = s.color(p, "eta"), mirror = false;
  if (p.has("k")) m.k = s.color(p, "k"), mirror = false;
  const double outside = p.is_0x() || p.has("ext_eta") ? s.index_of_refraction(p, "ext_eta") : 1.0;
  if (!mirror) divide(m.eta, outside), divide(m.k, outside);
  read_values(s, p, m);
  out.model = m;
}

constexpr Parameter kMetal{.name = "material",
                           .type = string,
                           .preset = "none",
                           .note = "name of a metal, or none for a perfect mirror",
                           .preset_0x = "Cu"};
constexpr Parameter kExtEta{.name = "ext_eta",
                            .type = ior,
                            .preset = "air",
                            .note = "index outside, by which eta and k are divided",
                            .versions = v0};
ParameterList of_conductor(std::string_view names) {
  return parameters_of<ConductorMaterial>(names);
}

}  // namespace

Plugin conductor() {
  return bsdf<ConductorMaterial>(
      {.parameters = {kMetal, of_conductor("eta k"), kExtEta, of_conductor("specular_reflectance")},
       .reader = &read_conductor});
}

Plugin roughconductor() {
  return bsdf<ConductorMaterial>(
      {.name = "roughconductor",
       .parameters = {kMetal, of_conductor("eta k"), kExtEta,
                      of_conductor("specular_reflectance distribution alpha alpha_u alpha_v "
                                   "sample_visible")},
       .reader = &read_conductor});
}

}  // namespace duet::plugins
