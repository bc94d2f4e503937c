// What the values of a BSDF cannot be, beyond the range of each.
#include "mitsuba/plugins/bsdfs.h"
#include "mitsuba/scene_reader.h"

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

void check_phong(SceneReader& s, Properties& p, PhongMaterial& m) {
  if (const double* exponent = std::get_if<double>(&m.exponent); exponent && *exponent < 0)
    p.error("exponent", "an exponent must not be negative");
  conserve_energy(s, p, m.diffuse_reflectance, m.specular_reflectance);
}

void check_ward(SceneReader& s, Properties& p, WardMaterial& m) {
  conserve_energy(s, p, m.diffuse_reflectance, m.specular_reflectance);
}

bool check_coating(SceneReader&, Properties& p, CoatingMaterial& m) {
  if (!(m.eta > 1))
    p.error("int_ior", "the index of refraction of a coating must be larger inside than outside");
  const size_t count = p.children(PluginKind::bsdf).size();
  if (count != 1) p.needs("one nested BSDF, not {}", count);
  return count == 1;
}

void check_hair(SceneReader&, Properties& p, HairMaterial& m) {
  if (m.eta == FloatInput(1.0)) p.error("int_ior", "the indices of refraction of hair must differ");
  const bool pigments = p.has("eumelanin") || p.has("pheomelanin");
  for (const char* name : {"sigma_a", "reflectance"})
    if (pigments && p.has(name))
      p.error(name, "either \"{}\" or concentrations of pigments can be given", name);
  p.only_one("sigma_a", "reflectance");
}

void check_pplastic(SceneReader&, Properties& p, PolarizedPlasticMaterial& m) {
  if (m.eta == 1) p.error("int_ior", "the indices of refraction of \"pplastic\" must differ");
}

void check_principled(SceneReader&, Properties& p, PrincipledMaterial&) {
  p.only_one("eta", "specular");
}

}  // namespace duet::plugins
