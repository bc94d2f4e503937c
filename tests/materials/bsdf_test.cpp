#include "materials/bsdf.h"

#include "support/bsdf_checks.h"

using namespace duet;
using namespace duet::test;

TEST_CASE("photons are merged unless most of the light is scattered by nearly specular lobes") {
  const auto merges = [](const char* description) {
    const TestMaterial material(description);
    const Surface surface = flat_surface();
    const bool above = material->bind(surface, normalize(Vector3f(0.3f, 0.1f, 0.9f))).merges();
    // The same from everywhere: walks from both ends must agree.
    for (const Vector3f& wo : {Vector3f(0.99f, 0, 0.1f), Vector3f(0, 0.5f, -1)})
      CHECK(material->bind(surface, normalize(wo)).merges() == above);
    return above;
  };
  CHECK(merges(R"({"type": "diffuse"})"));
  CHECK(!merges(R"({"type": "roughconductor", "alpha": 0.049})"));
  CHECK(merges(R"({"type": "roughconductor", "alpha": 0.051})"));
  CHECK(!merges(R"({"type": "roughconductor", "alpha_u": 0.3, "alpha_v": 0.02})"));
  CHECK(!merges(R"({"type": "roughdielectric", "alpha": 0.005})"));
  CHECK(merges(R"({"type": "roughdielectric", "alpha": 0.1})"));
  // A sharp coat over a base that scatters most of the light, or none.
  CHECK(merges(R"({"type": "roughplastic", "alpha": 0.01})"));
  CHECK(!merges(R"({"type": "roughplastic", "alpha": 0.01, "diffuse_reflectance": 0})"));
  CHECK(merges(R"({"type": "roughplastic", "alpha": 0.1, "diffuse_reflectance": 0})"));
  CHECK(merges(R"({"type": "principled", "roughness": 0.1})"));
  CHECK(!merges(R"({"type": "principled", "roughness": 0.1, "metallic": 0.9})"));
  CHECK(!merges(R"({"type": "principled", "roughness": 0.1, "spec_trans": 1.0})"));
  CHECK(merges(R"({"type": "principled", "roughness": 0.3, "metallic": 1.0})"));
}

TEST_CASE("of a blend the larger part decides whether photons are merged") {
  const auto merges = [](const char* weight) {
    const TestMaterial material(
        (std::string(R"({"type": "blendbsdf", "weight": )") + weight +
         R"(, "nested": [{"type": "diffuse"}, {"type": "roughconductor", "alpha": 0.01}]})")
            .c_str());
    return material->bind(flat_surface(), Vector3f(0, 0, 1)).merges();
  };
  CHECK(merges("0.0"));
  CHECK(merges("0.4"));
  CHECK(!merges("0.6"));
  CHECK(!merges("1.0"));
}

TEST_CASE("within a nearly specular lobe nothing is merged, even if it is the smaller part") {
  const auto bound = [](const char* description) {
    const TestMaterial material(description);
    return material->bind(flat_surface(), normalize(Vector3f(0.3f, 0.1f, 0.9f)));
  };
  const Bsdf sharp = bound(R"({"type": "roughplastic", "alpha": 0.01})"),
             blunt = bound(R"({"type": "roughplastic", "alpha": 0.06})"),
             metal = bound(R"({"type": "roughconductor", "alpha": 0.01})");
  CHECK(sharp.has_nearly_specular());
  CHECK(!blunt.has_nearly_specular());
  CHECK(sharp.merges(30, 0.1f));
  CHECK(!sharp.merges(33, 0.1f));
  CHECK(!sharp.merges(0.1f, 33));
  CHECK(blunt.merges(33, 33));
  CHECK(!metal.merges(0.1f, 0.1f));
}
