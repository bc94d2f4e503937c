// The short cut for constant diffuse materials gives what their Bsdf gives.
#include "materials/plain_diffuse.h"

#include <doctest/doctest.h>

#include "math/sampler.h"
#include "support/test_material.h"

using namespace duet;
using namespace duet::test;

namespace {

Vector3f next_direction(Sampler& sampler) {
  return square_to_sphere(sampler.next_2d());
}

void compare(const char* description) {
  CAPTURE(description);
  const TestMaterial material(description);
  REQUIRE(PlainDiffuse::suits(*material));
  Surface surface = flat_surface();
  Sampler sampler(SampleSequence::independent, 1, 0, 0);
  sampler.start_sample(0);
  for (int i = 0; i < 1000; ++i) {
    surface.shading = Frame(Normal3f(next_direction(sampler)));
    const Vector3f wo = next_direction(sampler), wi = next_direction(sampler);
    const PlainDiffuse plain(*material, surface, wo);
    const Bsdf bsdf = material->bind(surface, wo);
    CHECK(plain.has_smooth() == bsdf.has_smooth());
    CHECK(plain.needs_choice() == bsdf.needs_choice());
    const BsdfEval a = plain.eval(wi, Transport::radiance), b = bsdf.eval(wi, Transport::radiance);
    CHECK(a.pdf.value == doctest::Approx(b.pdf.value).epsilon(1e-5));
    CHECK(a.value.g == doctest::Approx(b.value.g).epsilon(1e-5));
    const Point2f v = sampler.next_2d();
    const auto s = plain.sample(0.5f, v, Transport::radiance);
    const auto t = bsdf.sample(0.5f, v, Transport::radiance);
    REQUIRE(s.has_value() == t.has_value());
    if (!s) continue;
    CHECK(length(s->wi - t->wi) < 1e-6f);
    CHECK(s->weight == t->weight);
    CHECK(s->pdf.value == doctest::Approx(t->pdf.value).epsilon(1e-5));
    CHECK(!s->delta);
  }
}

}  // namespace

TEST_CASE("a plain diffuse material is what its Bsdf is, on either side") {
  compare(R"({"type": "diffuse", "reflectance": [0.2, 0.5, 0.8]})");
  compare(
      R"({"type": "twosided", "nested": [{"type": "diffuse", "reflectance": [0.2, 0.5, 0.8]}]})");
  compare(R"({"type": "diffuse", "reflectance": [0, 0, 0]})");
}

TEST_CASE("other materials are not taken for plain diffuse ones") {
  for (const char* description :
       {R"({"type": "plastic"})", R"({"type": "conductor"})", R"({"type": "null"})",
        R"({"type": "mask", "opacity": 0.5, "nested": [{"type": "diffuse"}]})"})
    CHECK(!PlainDiffuse::suits(*TestMaterial(description)));
}
