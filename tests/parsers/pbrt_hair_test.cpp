// Hair of pbrt files whose colour, roughness, tilt or index a texture says.
#include <doctest/doctest.h>

#include "scene/build.h"
#include "support/pbrt_file.h"
#include "support/show.h"
#include "support/test_material.h"

using namespace duet;

namespace {

constexpr const char* kTextures =
    "Texture \"one\" \"float\" \"checkerboard\" \"float tex1\" 0.75 \"float tex2\" 0.75\n"
    "Texture \"two\" \"float\" \"checkerboard\" \"float tex1\" 2 \"float tex2\" 2\n"
    "Texture \"ten\" \"float\" \"checkerboard\" \"float tex1\" 10 \"float tex2\" 10\n"
    "Texture \"red\" \"spectrum\" \"checkerboard\" \"rgb tex1\" [.6 .2 .1] \"rgb tex2\" "
    "[.6 .2 .1]\n";

SceneDescription hair(const std::string& parameters) {
  return test::scene_of(test::read_pbrt_file_of(std::string("Film \"rgb\"\nWorldBegin\n") +
                                                kTextures + "Material \"hair\" " + parameters +
                                                "\nShape \"sphere\"\n"));
}

Spectrum scattered(SceneDescription d) {
  Diagnostics diagnostics;
  const auto scene = build_scene(std::move(d), {}, diagnostics);
  REQUIRE(scene);
  const Vector3f from = normalize(Vector3f(0.3f, 0.1f, 0.9f)),
                 to = normalize(Vector3f(-0.2f, -0.15f, -0.8f));
  return scene->materials.at(size_t(scene->shapes.at(0).material))
      ->bind(test::flat_surface(), from)
      .eval(to, Transport::radiance)
      .value;
}

}  // namespace

TEST_CASE("pbrt hair: textures mean what constants mean") {
  const char* const kPairs[][2] = {
      {"\"texture sigma_a\" \"red\"", "\"rgb sigma_a\" [.6 .2 .1]"},
      {"\"texture color\" \"red\" \"float beta_n\" .5",
       "\"rgb color\" [.6 .2 .1] \"float beta_n\" .5"},
      {"\"texture reflectance\" \"red\"", "\"rgb reflectance\" [.6 .2 .1]"},
      {"\"texture eumelanin\" \"one\"", "\"float eumelanin\" .75"},
      {"\"texture pheomelanin\" \"one\" \"float eumelanin\" .5",
       "\"float pheomelanin\" .75 \"float eumelanin\" .5"},
      {"\"texture beta_m\" \"one\"", "\"float beta_m\" .75"},
      {"\"texture beta_n\" \"one\"", "\"float beta_n\" .75"},
      {"\"texture beta_n\" \"one\" \"rgb color\" [.6 .2 .1]",
       "\"float beta_n\" .75 \"rgb color\" [.6 .2 .1]"},
      {"\"texture alpha\" \"ten\"", "\"float alpha\" 10"},
      {"\"texture eta\" \"two\"", "\"float eta\" 2"},
      // Roughnesses above one are one.
      {"\"texture beta_m\" \"ten\" \"texture beta_n\" \"ten\"",
       "\"float beta_m\" 1 \"float beta_n\" 1"}};
  for (const auto& [texture, constant] : kPairs) {
    SHOW(texture);
    const Spectrum a = scattered(hair(texture)), b = scattered(hair(constant));
    CHECK(b.r != b.b);
    for (int c = 0; c < 3; ++c) CHECK(a[c] == doctest::Approx(b[c]).epsilon(1e-5));
  }
}

TEST_CASE("pbrt hair: concentrations of pigments are not negative") {
  const SceneDescription d = hair("\"float eumelanin\" -1 \"float pheomelanin\" 0.25");
  const auto& m = d.materials.at(size_t(d.shapes.at(0).material)).model.get<HairMaterial>();
  CHECK(std::get<double>(m.eumelanin) == 0);
  CHECK(std::get<double>(m.pheomelanin) == 0.25);
}
