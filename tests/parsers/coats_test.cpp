// What the parameters of pbrt's BSDFs become when they stand in a Mitsuba file, and back.
#include <doctest/doctest.h>

#include "evaluate/report/description_text.h"
#include "mitsuba/writer.h"
#include "parsers/plugin_checks.h"

using namespace duet;
using namespace duet::test;

namespace {

/// Written and read again.
template <class T>
T bsdf_again(const T& bsdf) {
  SceneDescription d =
      read_scene("3.0.0", "<emitter type='constant'/><shape type='sphere'/>").description();
  d.materials.at(0).model = bsdf;
  const MitsubaXml xml = write_mitsuba_xml(d);
  CHECK(xml.losses.empty());
  const ReadResult r = read_text(xml.text);
  REQUIRE_MESSAGE(r.scene, r.messages());
  CHECK(r.messages() == "");
  return r.description().materials.at(0).model.get<T>();
}

}  // namespace

TEST_CASE("bsdf: coateddiffuse and coatedconductor") {
  CHECK(bsdf<CoatedDiffuseMaterial>("3.0.0", "coateddiffuse") == CoatedDiffuseMaterial{});
  CHECK(bsdf<CoatedConductorMaterial>("3.0.0", "coatedconductor") == CoatedConductorMaterial{});
  const auto d = bsdf<CoatedDiffuseMaterial>(
      "3.0.0", "coateddiffuse",
      "<rgb name='reflectance' value='0.1,0.2,0.3'/><float name='eta' value='1.3'/>"
      "<float name='alpha_u' value='0.3'/><float name='alpha_v' value='0.1'/>"
      "<float name='thickness' value='0.5'/><rgb name='albedo' value='0.7'/>"
      "<float name='g' value='0.4'/><float name='max_depth' value='20'/>"
      "<float name='samples' value='3'/>");
  CHECK(d.reflectance == ColorInput(Spectrum(0.1f, 0.2f, 0.3f)));
  CHECK(d.eta == 1.3);
  CHECK(d.alpha_u == FloatInput(0.3));
  CHECK(d.alpha_v == FloatInput(0.1));
  CHECK(d.thickness == FloatInput(0.5));
  CHECK(d.albedo == ColorInput(Spectrum(0.7f)));
  CHECK(d.g == FloatInput(0.4));
  CHECK(d.max_depth == 20);
  CHECK(d.samples == 3);
  CHECK(bsdf_again(d) == d);
  CoatedConductorMaterial c;
  c.reflectance = Spectrum(0.5f);
  c.conductor_alpha_u = 0.2, c.alpha_u = 0.1;
  CHECK(bsdf_again(c) == c);
  c.reflectance.reset();
  c.conductor_eta = Spectrum(0.25f, 0.5f, 1), c.conductor_k = Spectrum(4, 3, 2);
  CHECK(bsdf_again(c) == c);
  CHECK(read_scene("3.0.0", "<bsdf type='coateddiffuse'><float name='eta' value='-1'/></bsdf>")
            .has("\"eta\""));
  CHECK(read_scene("3.0.0", "<bsdf type='coateddiffuse'><float name='max_depth' value='0'/></bsdf>")
            .has("\"max_depth\""));
}

TEST_CASE("bsdf: what lobes coats have") {
  CoatedDiffuseMaterial d;
  CHECK(d.scattering().mirror);
  CHECK(d.scattering().diffuse);
  CHECK(!d.scattering().transmits());
  d.alpha_v = 0.1;
  CHECK(!d.scattering().mirror);
  CHECK(d.scattering().rough_reflection);
  CoatedConductorMaterial c;
  CHECK(c.scattering().mirror);
  CHECK(!c.scattering().has_smooth_lobe());
  c.albedo = Spectrum(0.1f);
  CHECK(c.scattering().has_smooth_lobe());
  c = {};
  c.conductor_alpha_u = 0.1;
  CHECK(c.scattering().mirror);
  CHECK(c.scattering().has_smooth_lobe());
}

TEST_CASE("bsdf: substrate and uber") {
  SubstrateMaterial s;
  s.diffuse_reflectance = Spectrum(0.25f);
  s.roughness = {MicrofacetDistribution::ggx_correlated, 0.25, 0.5, true};
  CHECK(bsdf_again(s) == s);
  CHECK(bsdf<SubstrateMaterial>("3.0.0", "substrate") == SubstrateMaterial{});
  CHECK(bsdf<UberMaterial>("3.0.0", "uber") == UberMaterial{});
  UberMaterial u;
  u.diffuse_transmittance = u.glossy_transmittance = Spectrum(0.25f);
  u.specular_reflectance = u.specular_transmittance = u.opacity = Spectrum(0.5f);
  u.eta = 1.25;
  CHECK(bsdf_again(u) == u);
  CHECK(u.scattering().see_through);
  CHECK(u.scattering().smooth_glass);
  CHECK(u.scattering().translucent);
  CHECK(!UberMaterial{}.scattering().transmits());
}

TEST_CASE("info says of coats what they are made of") {
  SceneDescription d =
      read_scene("3.0.0", "<emitter type='constant'/><shape type='sphere'/>").description();
  d.materials.at(0).model = CoatedDiffuseMaterial{};
  CHECK(DescriptionText(d).material(MaterialId{0}) ==
        "coateddiffuse 0.5, eta 1.5, alpha 0 and 0, thickness 0.01, albedo 0");
}
