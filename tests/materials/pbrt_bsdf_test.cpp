// BSDFs that are pbrt's: they are no cases of Mitsuba's table, and are held against their formulas.
#include "materials/coating.h"
#include "materials/conductor.h"
#include "math/sampler.h"
#include "support/bsdf_checks.h"
#include "support/statistics.h"

using namespace duet;
using namespace duet::test;
using nlohmann::json;

namespace {

const char* const kBsdfs[] = {
    R"({"type": "coateddiffuse"})",
    R"({"type": "coateddiffuse", "alpha": 0.3, "thickness": 0.3, "reflectance": [0.9, 0.5, 0.1]})",
    R"({"type": "coateddiffuse", "alpha_u": 0.6, "alpha_v": 0.2, "albedo": 0.5, "samples": 4})",
    R"({"type": "coatedconductor"})",
    R"({"type": "coatedconductor", "conductor_alpha": 0.3})",
    R"({"type": "coatedconductor", "alpha": 0.4, "conductor_alpha": 0.1, "reflectance": 0.8})",
    R"({"type": "coatedconductor", "albedo": 0.8, "thickness": 0.5, "g": 0.5})",
    R"({"type": "substrate", "distribution": "ggx", "alpha": 0.3})",
    R"({"type": "substrate", "alpha_u": 0.5, "alpha_v": 0.2, "specular_reflectance": 0.1})",
    R"({"type": "uber", "distribution": "ggx_correlated", "alpha": 0.3})",
    R"({"type": "uber", "diffuse_transmittance": 0.3, "glossy_transmittance": 0.6, "alpha": 0.4,
        "distribution": "ggx_correlated"})",
    R"({"type": "uber", "specular_reflectance": [0.5, 0.3, 0.1], "specular_transmittance": 0.4,
        "opacity": [0.3, 0.6, 0.9]})",
    R"({"type": "uber", "diffuse_reflectance": 0.6, "diffuse_transmittance": 0.3,
        "glossy_reflectance": 0})",
    R"({"type": "roughconductor", "distribution": "ggx_correlated", "alpha": 0.4})",
    R"({"type": "roughdielectric", "distribution": "ggx_correlated", "alpha_u": 0.5, "alpha_v": 0.2})",
    R"({"type": "roughplastic", "distribution": "ggx_correlated", "alpha": 0.4})",
};

const Vector3f kDirections[] = {{0.1f, 0.05f, 0.99f},  {0.5f, -0.4f, 0.7f}, {-0.8f, 0.3f, 0.4f},
                                {-0.5f, -0.8f, 0.15f}, {0.3f, 0.2f, -0.9f}, {-0.7f, 0.2f, -0.5f},
                                {0.6f, 0.7f, -0.1f},   {0.02f, 0.01f, 1.0f}};

bool is_layered(const json& bsdf) {
  return std::string(bsdf["type"]).starts_with("coated");
}

float index_of(const json& bsdf) {
  return bsdf["type"] == "roughdielectric" ? 1.5046f / 1.000277f : 1.5f;
}

}  // namespace

TEST_SUITE("BSDFs of pbrt") {
  TEST_CASE("values are reciprocal, with the squared index for refraction") {
    const Surface surface = flat_surface();
    int reflected = 0, refracted = 0;
    for (const char* text_of : kBsdfs) {
      const json description = json::parse(text_of);
      const TestMaterial material(description);
      Failures failures(text_of);
      const float eta2 = sqr(index_of(description));
      for (const Vector3f& from : kDirections)
        for (const Vector3f& to : kDirections) {
          const Vector3f a = normalize(from), b = normalize(to);
          const auto f = [&](const Vector3f& wo, const Vector3f& wi, Transport t) {
            return material->bind(surface, wo).eval(wi, t).value / std::abs(wi.z);
          };
          const Spectrum there = f(a, b, Transport::radiance);
          if (!close(f(b, a, Transport::importance), there, 1e-3))
            failures.add(fmt::format("{} to {}: importance differs", text(a), text(b)));
          // Diffuse transmission has no index: the sum has two laws.
          const bool mixed = description.contains("diffuse_transmittance");
          if (a.z * b.z < 0 && mixed) continue;
          const Spectrum back = f(b, a, Transport::radiance);
          const float scale = a.z * b.z > 0 ? 1 : a.z > 0 ? eta2 : 1 / eta2;
          if (!there.is_black()) ++(a.z * b.z > 0 ? reflected : refracted);
          if (!close(there * scale, back, 1e-3))
            failures.add(
                fmt::format("{} to {}: {}, back {}", text(a), text(b), text(there), text(back)));
        }
    }
    CHECK(reflected > 200);
    CHECK(refracted > 5);
  }

  TEST_CASE("weight is value over density, and densities are those of eval and of the other end") {
    const Surface surface = flat_surface();
    int compared = 0;
    for (const char* text_of : kBsdfs) {
      const TestMaterial material(text_of);
      Failures failures(text_of);
      for (const Vector3f& from : kDirections) {
        const Vector3f wo = normalize(from);
        const Bsdf bsdf = material->bind(surface, wo);
        Sampler sampler(SampleSequence::independent, 3, 0, 0);
        for (uint32_t i = 0; i < 300; ++i) {
          sampler.start_sample(i);
          const Point2f v = sampler.next_2d();
          const Transport transport = kTransports[i % 2];
          const auto s = bsdf.sample(sampler.next_1d(), v, transport);
          if (!s || s->delta) continue;
          ++compared;
          const BsdfEval e = bsdf.eval(s->wi, transport);
          if (!close(double(s->pdf.value), double(e.pdf.value), 2e-3) ||
              !close(s->weight * s->pdf.value, e.value, 2e-3))
            failures.add(fmt::format("{} to {}: {} at {}, eval {} at {}", text(wo), text(s->wi),
                                     text(s->weight * s->pdf.value), s->pdf.value, text(e.value),
                                     e.pdf.value));
          const float reverse = bsdf.reverse_pdf(s->wi, transport).value;
          const float other =
              material->bind(surface, s->wi).eval(wo, opposite(transport)).pdf.value;
          if (!close(double(reverse), double(other), 1e-4))
            failures.add(fmt::format("{} to {}: reverse {}, other end {}", text(wo), text(s->wi),
                                     reverse, other));
        }
      }
    }
    CHECK(compared > 15000);
  }

  TEST_CASE("coats send back no more than they get") {
    for (const char* text_of : kBsdfs) {
      json description = json::parse(text_of);
      if (!is_layered(description)) continue;
      description["reflectance"] = 1;
      if (description.contains("albedo")) description["albedo"] = 1;
      description["max_depth"] = 200;
      const TestMaterial material(description);
      Failures failures(text_of);
      for (const Vector3f& from : kDirections) {
        if (from.z < 0) continue;
        Surface surface = flat_surface();
        Moments sum;
        Sampler sampler(SampleSequence::sobol, 5, 0, 0);
        for (uint32_t i = 0; i < 16384; ++i) {
          sampler.start_sample(i);
          surface.position = {float(i), 0, 0};
          const Point2f v = sampler.next_2d();
          const auto s = material->bind(surface, normalize(from))
                             .sample(sampler.next_1d(), v, Transport::radiance);
          sum.add(s ? double(s->weight.max()) : 0.0);
        }
        if (!(sum.mean() <= 1 + 4 * sum.error() + 1e-3))
          failures.add(fmt::format("{}: {} ± {}", text(from), sum.mean(), sum.error()));
      }
    }
  }

  TEST_CASE("correlated masking: the value is that of the formula, and what a metal keeps pbrt's") {
    const float au = 0.5f, av = 0.2f;
    const Microfacet facets(MicrofacetDistribution::ggx_correlated, au, av, true);
    const auto lambda = [&](const Vector3f& w) {
      const double t2 =
          (sqr(double(au) * double(w.x)) + sqr(double(av) * double(w.y))) / sqr(double(w.z));
      return (std::sqrt(1 + t2) - 1) / 2;
    };
    for (const Vector3f& from : kDirections)
      for (const Vector3f& to : kDirections) {
        if (from.z < 0 || to.z < 0) continue;
        const Vector3f o = normalize(from), i = normalize(to), h = normalize(o + i);
        const double g2 = 1 / (1 + lambda(o) + lambda(i));
        const double expected = double(facets.density(h)) * g2 / (4 * double(o.z));
        CHECK(double(facets.reflection(o, i).value) == doctest::Approx(expected).epsilon(1e-4));
      }
    // η = 1 and k = 2 √r / √(1 − r) reflect r = 0.8 along the normal.
    for (const auto& [alpha, kept] : {std::pair{0.3f, 0.7007}, {0.6f, 0.473}}) {
      const TestMaterial metal(json{{"type", "roughconductor"},
                                    {"distribution", "ggx_correlated"},
                                    {"alpha", alpha},
                                    {"eta", 1},
                                    {"k", 4}});
      const Bsdf bsdf = metal->bind(flat_surface(), {0, 0, 1});
      Moments sum;
      for (uint32_t i = 0; i < 65536; ++i) {
        const auto s = bsdf.sample(
            0.5f, {(float(i) + 0.5f) / 65536, to_unit_float(reverse_bits(i))}, Transport::radiance);
        sum.add(s ? double(s->weight.g) : 0.0);
      }
      CHECK(sum.mean() == doctest::Approx(kept).epsilon(1e-3));
    }
  }

  TEST_CASE("correlated masking: tables of rough coats") {
    for (const float alpha : {0.2f, 0.7f}) {
      const RoughTransmittance tables(MicrofacetDistribution::ggx_correlated, 1.5f, alpha);
      const RoughDielectricModel coat{
          Microfacet(MicrofacetDistribution::ggx_correlated, alpha, alpha, true), 1.5f, Spectrum(0),
          Spectrum(1)};
      for (const float z : {0.2f, 0.6f, 1.0f}) {
        Moments sum;
        for (uint32_t i = 0; i < 16384; ++i) {
          const auto s = coat.sample({std::sqrt(1 - z * z), 0, z}, 0.5f,
                                     {(float(i) + 0.5f) / 16384, to_unit_float(reverse_bits(i))},
                                     Transport::importance);
          sum.add(s ? double(s->weight.g) : 0.0);
        }
        CHECK(tables(alpha).external(z) == doctest::Approx(sum.mean()).epsilon(0.005));
      }
    }
  }

  TEST_CASE("substrate: the formula of Ashikhmin and Shirley") {
    const double rd = 0.6, rs = 0.2, alpha = 0.3;
    const TestMaterial material(json{{"type", "substrate"},
                                     {"distribution", "ggx"},
                                     {"diffuse_reflectance", rd},
                                     {"specular_reflectance", rs},
                                     {"alpha", alpha}});
    for (const Vector3f& from : kDirections)
      for (const Vector3f& to : kDirections) {
        const Vector3f o = normalize(from), i = normalize(to);
        const double value =
            double(material->bind(flat_surface(), o).eval(i, Transport::radiance).value.g);
        if (o.z <= 0 || i.z <= 0) {
          CHECK(value == 0);
          continue;
        }
        const Vector3f h = normalize(o + i);
        const double oz = double(o.z), iz = double(i.z), hz2 = sqr(double(h.z)),
                     ih = double(dot(i, h));
        const double d = 1 / (M_PI * alpha * alpha * sqr((1 - hz2) / (alpha * alpha) + hz2));
        const double fresnel = rs + (1 - rs) * std::pow(1 - ih, 5);
        const double base = 28 * rd / (23 * M_PI) * (1 - rs) * (1 - std::pow(1 - oz / 2, 5)) *
                            (1 - std::pow(1 - iz / 2, 5));
        const double f = base + d * fresnel / (4 * ih * std::max(oz, iz));
        CHECK(value == doctest::Approx(f * iz).epsilon(2e-4));
      }
  }

  TEST_CASE("uber: what lets no light pass looks the same from both sides") {
    const TestMaterial plastic(R"({"type": "uber", "alpha": 0.3})");
    for (const Vector3f& from : kDirections)
      for (const Vector3f& to : kDirections) {
        const auto value = [&](float side) {
          const Vector3f o = normalize(Vector3f(from.x, from.y, from.z * side));
          const Vector3f i = normalize(Vector3f(to.x, to.y, to.z * side));
          return plastic->bind(flat_surface(), o).eval(i, Transport::radiance).value.g;
        };
        CHECK(value(1) == doctest::Approx(value(-1)).epsilon(1e-5));
        CHECK((value(1) > 0) == (from.z * to.z > 0));
      }
  }

  TEST_CASE("uber: the sum of its lobes") {
    const TestMaterial sum(R"({"type": "uber", "distribution": "ggx_correlated", "alpha": 0.3,
      "diffuse_reflectance": 0.4, "diffuse_transmittance": 0.2, "glossy_reflectance": 0.8,
      "glossy_transmittance": 0.3, "specular_reflectance": 0.5, "specular_transmittance": 0.7,
      "opacity": 0.6, "eta": 1.5})");
    const RoughDielectricModel glossy{
        Microfacet(MicrofacetDistribution::ggx_correlated, 0.3f, 0.3f, true), 1.5f, Spectrum(0.8f),
        Spectrum(0.3f)};
    const Surface surface = flat_surface();
    for (const Vector3f& from : kDirections) {
      const Vector3f o = normalize(from);
      const Bsdf bsdf = sum->bind(surface, o);
      for (const Vector3f& to : kDirections)
        for (const Transport transport : kTransports) {
          const Vector3f i = normalize(to);
          const float diffuse = (o.z * i.z > 0 ? 0.4f : 0.2f) * std::abs(i.z) * kInvPi;
          const float expected = 0.6f * (diffuse + glossy.eval(o, i, transport).value.g);
          CHECK(bsdf.eval(i, transport).value.g == doctest::Approx(expected).epsilon(1e-4));
        }
      CHECK(bsdf.straight_through().g == doctest::Approx(0.4).epsilon(1e-5));
      // Coefficients of the delta lobes.
      const float relative = o.z > 0 ? 1.5f : 1 / 1.5f;
      const float f = fresnel_dielectric(std::abs(o.z), relative).reflectance;
      double reflected = 0, refracted = 0, straight = 0;
      constexpr int n = 20000;
      for (int k = 0; k < n; ++k) {
        const auto s = bsdf.sample((float(k) + 0.5f) / n, {0.3f, 0.6f}, Transport::importance);
        if (!s || !s->delta) continue;
        (s->null ? straight : s->wi.z * o.z > 0 ? reflected : refracted) += double(s->weight.g) / n;
      }
      CHECK(reflected == doctest::Approx(0.6 * 0.5 * double(f)).epsilon(0.01));
      CHECK(refracted == doctest::Approx(0.6 * 0.7 * double(1 - f)).epsilon(0.01));
      CHECK(straight == doctest::Approx(0.4).epsilon(0.01));
    }
  }
}
