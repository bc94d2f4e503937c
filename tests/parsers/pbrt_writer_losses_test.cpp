// What is said of that which pbrt-v4 cannot express.
#include "pbrt/writer.h"

#include <doctest/doctest.h>

#include "support/memory_scene.h"
#include "support/pbrt_round_trip.h"

using namespace duet;
using namespace duet::test;

TEST_CASE("pbrt writer: what pbrt cannot say is named, and something near takes its place") {
  const auto loses = [](const ConductorMaterial& metal) {
    SceneDescription d = read_pbrt_text("Shape \"sphere\"");
    d.materials.push_back({{}, {}, metal});
    d.shapes[0].material = MaterialId(d.materials.size() - 1);
    return pbrt::write_pbrt(d);
  };
  ConductorMaterial mirror;
  mirror.eta = Spectrum(0.0f), mirror.k = Spectrum(1.0f);
  mirror.specular_reflectance = Spectrum(0.5f, 0.25f, 0.75f);
  const pbrt::PbrtText written = loses(mirror);
  const std::string factor =
                        "a metal's reflection that has a factor is right along the normal only",
                    sides =
                        "what scatters light on one side of a surface only does so on both sides";
  CHECK(written.losses == std::vector<std::string>{sides, factor});
  for (const std::string& loss : written.losses)
    CHECK(written.text.find("# Not in pbrt-v4: " + loss + "\n") != std::string::npos);
  CHECK(written.text.find("\"rgb reflectance\" [0.5 0.25 0.75]") != std::string::npos);
}

TEST_CASE("pbrt writer: BSDFs, lights, media and sensors that pbrt does not have are named") {
  const auto losses_of = [](const std::string& content) {
    const ReadResult r = read_scene("3.0.0", content);
    REQUIRE_MESSAGE(r.scene, r.messages());
    std::string all;
    for (const std::string& loss : pbrt::write_pbrt(r.description()).losses) all += loss + "\n";
    return all;
  };
  const auto has = [&](const std::string& content, const std::string& loss) {
    CAPTURE(content);
    const std::string all = losses_of(content);
    CHECK_MESSAGE(all.find(loss) != all.npos, all);
  };
  const auto on_sphere = [](const std::string& bsdf) {
    return "<shape type='sphere'>" + bsdf + "</shape>";
  };
  const std::string bumps =
      "<bsdf type='bumpmap'><texture type='checkerboard'/><bsdf type='diffuse'/></bsdf>";
  has(on_sphere(bumps), "bumps stretch the surface where it bends, as in pbrt");
  has("<shape type='cube'>" + bumps + "</shape>", "bumps on meshes with normals have the tangents");
  has(on_sphere("<bsdf type='bumpmap'><texture type='checkerboard'/>" + bumps + "</bsdf>"),
      "a bump or normal map within another one is missing");
  has(on_sphere("<bsdf type='principled'/>"), "the BSDF \"principled\" does not exist in pbrt");
  has(on_sphere("<bsdf type='roughconductor'/>"), "the microfacets of \"beckmann\"");
  has(on_sphere(
          "<bsdf type='dielectric'><rgb name='specular_reflectance' value='1,0.5,1'/></bsdf>"),
      "the factor of a dielectric's reflection is missing");
  has(on_sphere("<bsdf type='null'/><medium type='homogeneous' name='interior'>"
                "<phase type='rayleigh'/></medium>"),
      "the phase function \"rayleigh\" is isotropic");
  has("<emitter type='spot'/>", "the edge of a spot light");
  has("<emitter type='constant'/><sensor type='perspective'/>",
      "of several sensors only the first");
  has("<shape type='sphere'><emitter type='directionalarea'/></shape>",
      "light along the normals of a surface is missing");
  // A smooth dielectric under a constant sky is all there in pbrt.
  CHECK(losses_of(on_sphere("<bsdf type='dielectric'/>")).find("dielectric") == std::string::npos);
}
