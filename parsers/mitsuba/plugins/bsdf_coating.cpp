#include "mitsuba/plugins/bsdf.h"
#include "mitsuba/plugins/bsdfs.h"

namespace duet::plugins {

namespace {

void read_coating(SceneReader& s, Properties& p, MaterialDescription& out) {
  CoatingMaterial m;
  read_values(s, p, m);
  if (!(m.eta > 1))
    p.error("int_ior", "the index of refraction of a coating must be larger inside than outside");
  if (const size_t count = p.children(PluginKind::bsdf).size(); count != 1)
    return s.report().error(p.node().where, "{} needs one nested BSDF, not {}", describe(p.node()),
                            count);
  if (read_nested(s, p, m)) out.model = m;
}

constexpr const char* kNote = "holds a BSDF; Mitsuba 3 has none";

}  // namespace

Plugin coating() {
  return bsdf<CoatingMaterial>({.reader = &read_coating, .note = kNote});
}

Plugin roughcoating() {
  return rough_bsdf<CoatingMaterial>(
      {.name = "roughcoating", .reader = &read_coating, .note = kNote});
}

}  // namespace duet::plugins
