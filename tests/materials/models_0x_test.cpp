// Models that only Mitsuba 0.6 has: against what their papers say of them.
#include "math/sampler.h"
#include "support/bsdf_checks.h"
#include "support/statistics.h"

using namespace duet;
using namespace duet::test;
using nlohmann::json;

namespace {

const Vector3f kOldViews[] = {
    {0, 0, 1}, {0.4f, -0.3f, 0.8f}, {-0.7f, 0.5f, 0.25f}, {1, 0.3f, 0.1f}};

/// f itself, without the cosine.
float f(const TestMaterial& m, const Vector3f& wo, const Vector3f& wi) {
  return m->bind(flat_surface(), normalize(wo)).eval(normalize(wi), Transport::radiance).value.r /
         std::abs(normalize(wi).z);
}

double albedo(const TestMaterial& m, const Vector3f& wo) {
  const Bsdf bsdf = m->bind(flat_surface(), normalize(wo));
  Moments sum;
  Sampler sampler(SampleSequence::sobol, 3, 0, 0);
  for (uint32_t i = 0; i < 16384; ++i) {
    sampler.start_sample(i);
    const Point2f v = sampler.next_2d();
    const auto s = bsdf.sample(sampler.next_1d(), v, Transport::radiance);
    sum.add(s ? double(s->weight.r) : 0.0);
  }
  return sum.mean();
}

TestMaterial make(const std::string& text) {
  return TestMaterial(json::parse(text));
}

}  // namespace

TEST_SUITE("models of Mitsuba 0.6") {
  TEST_CASE("they are reciprocal") {
    for (const char* text :
         {R"({"type": "phong", "exponent": 20})", R"({"type": "ward", "alpha_u": 0.4})",
          R"({"type": "ward", "variant": "ward"})", R"({"type": "ward", "variant": "ward-duer"})",
          R"({"type": "roughdiffuse", "alpha": 0.7})",
          R"({"type": "roughdiffuse", "alpha": 0.7, "fast": true})",
          R"({"type": "coating", "sigma_a": 0.3, "nested": [{"type": "diffuse"}]})",
          R"({"type": "coating", "nested": [{"type": "roughconductor", "alpha": 0.4}]})",
          R"({"type": "roughcoating", "alpha": 0.3, "nested": [{"type": "diffuse"}]})",
          R"({"type": "hk", "sigma_s": 1.5, "sigma_a": 0.2, "g": 0.4})",
          R"({"type": "mixturebsdf", "weights": [0.3, 0.6], "nested": [{"type": "phong"},
              {"type": "ward", "alpha_u": 0.4}]})"}) {
      CAPTURE(std::string(text));
      const TestMaterial m = make(text);
      for (const Vector3f& a : kOldViews)
        for (const Vector3f& b : kOldViews)
          CHECK(f(m, a, b) == doctest::Approx(double(f(m, b, a))).epsilon(1e-4));
    }
  }

  TEST_CASE("they reflect no more than they get") {
    for (
        const char* text :
        {R"({"type": "phong", "exponent": 20, "diffuse_reflectance": 0, "specular_reflectance": 1})",
         R"({"type": "ward", "alpha_u": 0.4, "diffuse_reflectance": 0, "specular_reflectance": 1})",
         R"({"type": "roughdiffuse", "alpha": 0.7, "reflectance": 1})",
         R"({"type": "difftrans", "transmittance": 1})",
         R"({"type": "coating", "nested": [{"type": "diffuse", "reflectance": 1}]})",
         R"({"type": "coating", "nested": [{"type": "roughconductor", "alpha": 0.3, "eta": 0}]})",
         R"({"type": "roughcoating", "alpha": 0.3, "nested": [
             {"type": "diffuse", "reflectance": 1}]})",
         R"({"type": "roughcoating", "alpha": 0.3, "nested": [{"type": "conductor", "eta": 0}]})",
         R"({"type": "hk", "sigma_s": 2, "sigma_a": 0, "g": 0.4})",
         R"({"type": "mixturebsdf", "weights": [0.3, 0.7], "nested": [
             {"type": "diffuse", "reflectance": 1}, {"type": "conductor", "eta": 0}]})"}) {
      CAPTURE(std::string(text));
      for (const Vector3f& w : kOldViews) CHECK(albedo(make(text), w) < 1.003);
    }
  }

  TEST_CASE("a coat keeps what Fresnel and Beer say of light along the normal") {
    // The surface reflects a share r; the rest goes through it twice and back and forth through
    // the layer. What the surface throws back onto the base is lost, as in Mitsuba 0.6.
    const double r = 0.04, through = (1 - r) * (1 - r);
    for (const double sigma_a : {0.0, 0.7})
      for (const char* type : {"coating", "roughcoating"})
        CHECK(albedo(TestMaterial(json{{"type", type},
                                       {"int_ior", 1.5},
                                       {"ext_ior", 1},
                                       {"alpha", 0.01},
                                       {"sigma_a", sigma_a},
                                       {"nested", {json{{"type", "conductor"}, {"eta", 0}}}}}),
                     {0, 0, 1}) ==
              doctest::Approx(r + through * std::exp(-2 * sigma_a)).epsilon(0.002));
  }

  TEST_CASE("a coat of the index of its surroundings is not there") {
    for (const char* base : {R"({"type": "diffuse", "reflectance": 0.6})",
                             R"({"type": "roughconductor", "alpha": 0.4})"}) {
      const json nested = json::parse(base);
      const TestMaterial bare(nested),
          coated(json{{"type", "coating"}, {"int_ior", 1}, {"ext_ior", 1}, {"nested", {nested}}});
      for (const Vector3f& a : kOldViews)
        for (const Vector3f& b : kOldViews)
          CHECK(f(coated, a, b) == doctest::Approx(double(f(bare, a, b))).epsilon(1e-4));
    }
  }

  TEST_CASE("a thin layer that absorbs nothing scatters or lets through nearly all light") {
    // Single scattering only: in a thin layer there is hardly any other.
    const TestMaterial m = make(R"({"type": "hk", "sigma_s": 0.02, "sigma_a": 0, "g": 0.4})");
    CHECK(albedo(m, {0, 0, 1}) == doctest::Approx(1).epsilon(0.001));
  }

  TEST_CASE("a mixture reflects the weighted sum of its parts") {
    const TestMaterial m = make(R"({"type": "mixturebsdf", "weights": [0.3, 0.2], "nested": [
        {"type": "diffuse", "reflectance": 0.5}, {"type": "conductor", "eta": 0}]})");
    for (const Vector3f& w : kOldViews) CHECK(albedo(m, w) == doctest::Approx(0.35).epsilon(0.005));
  }

  TEST_CASE("Phong's lobe is normalised for light along the normal") {
    for (const int exponent : {0, 1, 10, 200})
      CHECK(albedo(TestMaterial({{"type", "phong"},
                                 {"exponent", exponent},
                                 {"diffuse_reflectance", 0},
                                 {"specular_reflectance", 1}}),
                   {0, 0, 1}) == doctest::Approx(1).epsilon(0.01));
  }

  TEST_CASE("Ward's narrow lobes reflect all light along the normal in each variant") {
    for (const char* variant : {"ward", "ward-duer", "balanced"})
      CHECK(albedo(TestMaterial({{"type", "ward"},
                                 {"variant", variant},
                                 {"alpha_u", 0.05},
                                 {"alpha_v", 0.02},
                                 {"diffuse_reflectance", 0},
                                 {"specular_reflectance", 1}}),
                   {0, 0, 1}) == doctest::Approx(1).epsilon(0.02));
  }

  TEST_CASE("rough diffuse reflection is Lambert's without roughness, and backscatters with it") {
    const TestMaterial smooth = make(R"({"type": "roughdiffuse", "alpha": 0, "reflectance": 0.5})");
    for (const Vector3f& a : kOldViews)
      CHECK(f(smooth, a, {0.1f, 0.5f, 0.6f}) == doctest::Approx(0.5 / 3.14159265).epsilon(1e-4));
    for (const char* text : {R"({"type": "roughdiffuse", "alpha": 0.5})",
                             R"({"type": "roughdiffuse", "alpha": 0.5, "fast": true})"}) {
      const TestMaterial rough = make(text);
      const Vector3f low(0.9f, 0, 0.3f);
      CHECK(f(rough, low, low) > 1.3f * f(rough, low, {-0.9f, 0, 0.3f}));
    }
  }
}
