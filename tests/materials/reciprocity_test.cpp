// What materials do to light that goes the other way.
//
// Source of the relations: Veach, "Robust Monte Carlo Methods for Light Transport Simulation",
// 1997, section 5.2.
#include "materials/principled_materials.h"
#include "support/bsdf_checks.h"

using namespace duet;
using namespace duet::test;
using nlohmann::json;

namespace {

/// Rounding of directions moves values in narrow lobes.
constexpr double kTolerance = 2e-3;

/// Index below the surface over that above it, as light that is refracted meets it.
float relative_index(const json& bsdf) {
  const std::string type = bsdf["type"];
  if (type == "roughdielectric")
    return bsdf.value("int_ior", 1.5046f) / bsdf.value("ext_ior", 1.000277f);
  if (type == "principled") {
    if (bsdf.contains("eta")) return bsdf["eta"];
    return principled_eta(bsdf.value("specular", 0.5f), true);
  }
  float eta = 1;
  if (bsdf.contains("nested"))
    for (const json& n : bsdf["nested"]) eta *= relative_index(n);
  return eta;
}

/// f itself, without the cosine.
Spectrum f(const Material& material, const Vector3f& wo, const Vector3f& wi, Transport transport) {
  static const Surface surface = flat_surface();
  return material.bind(surface, wo).eval(wi, transport).value / std::abs(wi.z);
}

}  // namespace

TEST_SUITE("light that goes the other way") {
  TEST_CASE("importance and radiance see the same surface") {
    int compared = 0;
    for (const json& c : mitsuba_cases()) {
      const TestMaterial material(c["bsdf"]);
      Failures failures(c["name"]);
      for_each_pair(c, [&](size_t row, const Vector3f& a, const Vector3f& b) {
        const Spectrum radiance = f(*material, a, b, Transport::radiance);
        const Spectrum importance = f(*material, b, a, Transport::importance);
        compared += !radiance.is_black();
        if (!close(importance, radiance, kTolerance))
          failures.add(fmt::format("row {}: {}, {}", row, text(importance), text(radiance)));
      });
    }
    CHECK(compared > 2000);
  }

  TEST_CASE("reciprocity, with the squared index for refraction") {
    int reflected = 0, refracted = 0;
    for (const json& c : mitsuba_cases()) {
      const json& description = c["bsdf"];
      // Their rules differ for the eye's and the light's direction.
      if (perturbs(description) || description["type"] == "principledthin" ||
          description["type"] == "hair")
        continue;
      const TestMaterial material(description);
      Failures failures(c["name"]);
      for_each_pair(c, [&](size_t row, const Vector3f& a, const Vector3f& b) {
        const float eta2 = sqr(relative_index(description));
        for (const Transport transport : kTransports) {
          const Spectrum there = f(*material, a, b, transport);
          const Spectrum back = f(*material, b, a, transport);
          if (!there.is_black()) ++(a.z * b.z < 0 ? refracted : reflected);
          // Radiance is as η² of the side of wo, importance as that of wi.
          const float from = transport == Transport::radiance ? a.z : b.z;
          const float scale = a.z * b.z > 0 ? 1 : from > 0 ? eta2 : 1 / eta2;
          if (!close(there * scale, back, kTolerance))
            failures.add(fmt::format("row {}: {}, back {}", row, text(there), text(back)));
        }
      });
    }
    CHECK(reflected > 2000);
    CHECK(refracted > 500);
  }

  TEST_CASE("the reverse density is that of the other end") {
    const Surface surface = flat_surface();
    int compared = 0;
    for (const json& c : mitsuba_cases()) {
      const TestMaterial material(c["bsdf"]);
      Failures failures(c["name"]);
      for_each_pair(c, [&](size_t row, const Vector3f& a, const Vector3f& b) {
        const Bsdf here = material->bind(surface, a), there = material->bind(surface, b);
        for (const Transport transport : kTransports) {
          const float reverse = here.reverse_pdf(b, transport).value;
          const float other = there.eval(a, opposite(transport)).pdf.value;
          // At the horizon of bumps a direction that carries nothing may still be sampled.
          if (there.eval(a, opposite(transport)).value.is_black()) continue;
          ++compared;
          if (!close(double(reverse), double(other), 1e-5))
            failures.add(fmt::format("row {}: {}, {}", row, reverse, other));
        }
      });
    }
    CHECK(compared > 4000);
  }
}
