#include "mitsuba/plugins/bsdf.h"
#include "mitsuba/plugins/bsdfs.h"

namespace duet::plugins {

namespace {

void read_pplastic(SceneReader& s, Properties& p, MaterialDescription& out) {
  PolarizedPlasticMaterial m;
  read_values(s, p, m);
  if (m.eta == 1) p.error("int_ior", "the indices of refraction of \"pplastic\" must differ");
  out.model = m;
}

}  // namespace

Plugin pplastic() {
  return bsdf<PolarizedPlasticMaterial>({.versions = v3,
                                         .reader = &read_pplastic,
                                         .note = "as Mitsuba's variants without polarisation"});
}

}  // namespace duet::plugins
