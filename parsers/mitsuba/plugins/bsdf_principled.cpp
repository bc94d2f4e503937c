#include "mitsuba/plugins/bsdf.h"
#include "mitsuba/plugins/bsdfs.h"

namespace duet::plugins {

namespace {

void read_principled(SceneReader& s, Properties& p, MaterialDescription& out) {
  if (p.has("eta") && p.has("specular"))
    p.error("eta", "either \"eta\" or \"specular\" can be given");
  read_bsdf<PrincipledMaterial>(s, p, out);
}

}  // namespace

Plugin principled() {
  return bsdf<PrincipledMaterial>({.versions = v3, .reader = &read_principled});
}

}  // namespace duet::plugins
