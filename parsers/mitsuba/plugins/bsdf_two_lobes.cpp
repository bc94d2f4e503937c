// Phong's and Ward's BSDFs, which must not reflect more light than there is.
#include "mitsuba/plugins/bsdf.h"
#include "mitsuba/plugins/bsdfs.h"
#include "mitsuba/plugins/two_lobes.h"

namespace duet::plugins {

void conserve_energy(SceneReader& s, Properties& p, ColorInput& diffuse, ColorInput& specular) {
  Spectrum* const a = std::get_if<Spectrum>(&diffuse);
  Spectrum* const b = std::get_if<Spectrum>(&specular);
  if (!a || !b) return;
  const float sum = (*a + *b).max();
  if (!(sum > 1)) return;
  const float scale = 0.99f / sum;
  *a *= scale, *b *= scale;
  s.report().warning(p.node().where,
                     "{} would reflect {:.3g} times the light that meets it: both of its lobes are "
                     "scaled by {:.3g}",
                     describe(p.node()), sum, scale);
}

namespace {

void read_phong(SceneReader& s, Properties& p, MaterialDescription& out) {
  PhongMaterial m;
  read_values(s, p, m);
  if (const double* exponent = std::get_if<double>(&m.exponent); exponent && *exponent < 0)
    p.error("exponent", "an exponent must not be negative");
  conserve_energy(s, p, m.diffuse_reflectance, m.specular_reflectance);
  out.model = m;
}

void read_ward(SceneReader& s, Properties& p, MaterialDescription& out) {
  WardMaterial m;
  read_values(s, p, m);
  conserve_energy(s, p, m.diffuse_reflectance, m.specular_reflectance);
  out.model = m;
}

// They are listed with the glossy lobe first.
constexpr Parameter kPhong[] = {parameter_of<PhongMaterial>("exponent"), kGlossyReflectance,
                                kDiffuseReflectance};
constexpr Parameter kWard[] = {
    parameter_of<WardMaterial>("variant"), parameter_of<WardMaterial>("alpha_u"),
    parameter_of<WardMaterial>("alpha_v"), kGlossyReflectance, kDiffuseReflectance};

}  // namespace

Plugin phong() {
  return {
      .name = "phong", .parameters = kPhong, .reader = &read_phong, .note = "Mitsuba 3 has none"};
}

Plugin ward() {
  return {.name = "ward", .parameters = kWard, .reader = &read_ward, .note = "Mitsuba 3 has none"};
}

}  // namespace duet::plugins
