// What a description says of how its BSDF scatters is what the material does that is built of it.
#include "scene/scattering.h"

#include <doctest/doctest.h>

#include <set>

#include "mitsuba/vocabulary.h"
#include "scene/build.h"
#include "support/memory_scene.h"

using namespace duet;
using namespace duet::test;

namespace {

/// What must be nested in a plugin.
std::string nested_in(std::string_view name) {
  const std::string grey = "<bsdf type='diffuse'/>", board = "<texture type='checkerboard'/>";
  if (name == "twosided" || name == "mask" || name == "coating" || name == "roughcoating")
    return grey;
  if (name == "blendbsdf") return grey + "<bsdf type='dielectric'/>";
  if (name == "mixturebsdf")
    return "<string name='weights' value='0.5, 0.5'/>" + grey + "<bsdf type='difftrans'/>";
  if (name == "bumpmap" || name == "normalmap") return grey + board;
  return "";
}

}  // namespace

TEST_CASE("every BSDF lets light through if and only if its description says so") {
  // These read a file.
  const std::set<std::string_view> from_files{"irawan", "measured"};
  for (const Plugin& p : Vocabulary::built_in().plugins(PluginKind::bsdf)) {
    if (p.support == Support::refused || from_files.contains(p.name)) continue;
    for (const char* more : {"", "<float name='spec_trans' value='0.5'/>"}) {
      CAPTURE(p.name);
      CAPTURE(more);
      const ReadResult r =
          read_scene("3.0.0", "<shape type='sphere'><bsdf type='" + std::string(p.name) + "'>" +
                                  nested_in(p.name) + more + "</bsdf></shape>");
      REQUIRE_MESSAGE(r.scene, r.messages());
      const SceneDescription& d = r.description();
      const MaterialId id = d.shapes.at(0).material;
      const Scattering s = d.materials.at(size_t(id)).model.scattering();
      Diagnostics diagnostics;
      const auto scene = build_scene(d, {}, diagnostics);
      REQUIRE(scene);
      const Material& built = *scene->materials.at(scene->shapes.at(0).material);
      // A thin material could let light through, whatever its weights are.
      CHECK(transmits(d, id) == (built.transmits() || p.name == "principledthin"));
      CHECK((built.perturbs() || !s.bumps));
      // Panes of glass count as glass, though part of the light passes them straight.
      if (s.see_through) CHECK(built.passes_straight());
      const ConstantMaterial* constant = built.constant();
      if (constant && d.materials.at(size_t(id)).model.nested().empty()) {
        CHECK(constant->has_delta == (s.has_delta_lobe() || s.see_through));
        CHECK(constant->has_smooth == s.has_smooth_lobe());
      }
    }
  }
}
