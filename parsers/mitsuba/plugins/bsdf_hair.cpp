#include "mitsuba/plugins/bsdf.h"
#include "mitsuba/plugins/bsdfs.h"

namespace duet::plugins {

namespace {

void read_hair(SceneReader& s, Properties& p, MaterialDescription& out) {
  HairMaterial m;
  read_values(s, p, m);
  if (m.eta == 1) p.error("int_ior", "the indices of refraction of hair must differ");
  if (m.sigma_a && (p.has("eumelanin") || p.has("pheomelanin")))
    p.error("sigma_a", "either \"sigma_a\" or concentrations of pigments can be given");
  out.model = m;
}

}  // namespace

Plugin hair() {
  return bsdf<HairMaterial>({.versions = v3, .reader = &read_hair, .note = "for bsplinecurve"});
}

}  // namespace duet::plugins
