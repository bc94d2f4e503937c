// The white furnace: in even light, how much a material sends back of what it gets.
#include "math/sampler.h"
#include "support/bsdf_checks.h"
#include "support/statistics.h"

using namespace duet;
using namespace duet::test;
using nlohmann::json;

namespace {

const Vector3f kEnergyViews[] = {{0, 0, 1},          {0.4f, -0.3f, 0.8f}, {-0.7f, 0.5f, 0.25f},
                                 {1, 0.3f, 0.02f},   {0.3f, 0.3f, -0.9f}, {-0.7f, 0.1f, -0.5f},
                                 {0.9f, 0.9f, -0.2f}};

/// The description with all that absorbs made white.
json whitened(json bsdf) {
  for (const char* color : {"reflectance", "diffuse_reflectance", "specular_reflectance",
                            "specular_transmittance", "base_color"})
    if (bsdf.contains(color)) bsdf[color] = 1;
  const std::string type = bsdf["type"];
  if (type == "diffuse") bsdf["reflectance"] = 1;
  if (type == "plastic" || type == "roughplastic") bsdf["diffuse_reflectance"] = 1;
  if (type.starts_with("principled")) bsdf["base_color"] = 1;
  if (type.ends_with("conductor")) bsdf["eta"] = 0;
  if (bsdf.contains("nested"))
    for (json& n : bsdf["nested"]) n = whitened(n);
  return bsdf;
}

/// Share of the light that leaves again: radiance with the compression by refraction taken out.
Moments albedo(const Bsdf& bsdf, Transport transport) {
  Moments sum;
  Sampler sampler(SampleSequence::sobol, 5, 0, 0);
  for (uint32_t i = 0; i < 16384; ++i) {
    sampler.start_sample(i);
    const Point2f v = sampler.next_2d();
    const auto s = bsdf.sample(sampler.next_1d(), v, transport);
    const float scale = s && transport == Transport::radiance ? sqr(s->eta) : 1.0f;
    sum.add(s ? double(s->weight.max() * scale) : 0.0);
  }
  return sum;
}

}  // namespace

TEST_SUITE("white furnace") {
  TEST_CASE("perfect mirrors, clear glass and no surface at all keep all light") {
    const Surface surface = flat_surface();
    int tested = 0;
    for (const json& c : mitsuba_cases()) {
      const std::string type = c["bsdf"]["type"];
      if (type != "conductor" && type != "dielectric" && type != "thindielectric" && type != "null")
        continue;
      const TestMaterial material(whitened(c["bsdf"]));
      Failures failures(c["name"]);
      for (const Vector3f& view : kEnergyViews) {
        if (type == "conductor" && view.z < 0) continue;
        for (const Transport transport : kTransports) {
          const Moments m = albedo(material->bind(surface, normalize(view)), transport);
          // Colours are white, so each sample has the weight one.
          if (std::abs(m.mean() - 1) > 1e-5 || m.error() > 1e-6)
            failures.add(
                fmt::format("{}, {}: {} ± {}", text(view), name(transport), m.mean(), m.error()));
          ++tested;
        }
      }
    }
    CHECK(tested > 100);
  }

  TEST_CASE("a white diffuse surface keeps all light") {
    const Surface surface = flat_surface();
    const TestMaterial material(R"({"type": "diffuse", "reflectance": 1})");
    for (const Vector3f& view : kEnergyViews) {
      const Moments m = albedo(material->bind(surface, normalize(view)), Transport::radiance);
      CHECK(m.mean() == doctest::Approx(view.z > 0 ? 1 : 0).epsilon(1e-6));
    }
  }

  TEST_CASE("nothing but Burley's materials sends back more than it gets") {
    const Surface surface = flat_surface();
    int tested = 0;
    for (const json& c : mitsuba_cases()) {
      const json& description = c["bsdf"];
      const std::string type = description["type"];
      if (type.starts_with("principled")) continue;
      const TestMaterial material(whitened(description));
      Failures failures(c["name"]);
      for (const Vector3f& view : kEnergyViews)
        for (const Transport transport : kTransports) {
          // Importance under bump maps is scaled by the ratio of cosines, which has no bound.
          if (transport == Transport::importance &&
              (perturbs(description) || description["type"] == "hair"))
            continue;
          const Moments m = albedo(material->bind(surface, normalize(view)), transport);
          ++tested;
          // 0.1 %: the fit for what a plastic's coat reflects back onto its base.
          if (!(m.mean() <= 1 + 4 * m.error() + 1e-3))
            failures.add(
                fmt::format("{}, {}: {} ± {}", text(view), name(transport), m.mean(), m.error()));
        }
    }
    CHECK(tested > 1000);
  }

  TEST_CASE("Burley's metal and glass send back no more than they get") {
    const Surface surface = flat_surface();
    for (const char* kind : {"metallic", "spec_trans"})
      for (const float roughness : {0.05f, 0.3f, 0.6f, 1.0f})
        for (const float eta : {1.5f, 0.7f}) {
          const json description{{"type", "principled"},
                                 {"base_color", 1},
                                 {kind, 1},
                                 {"eta", eta},
                                 {"roughness", roughness}};
          const TestMaterial material(description);
          Failures failures(description.dump());
          for (const Vector3f& view : kEnergyViews)
            for (const Transport transport : kTransports) {
              const Moments m = albedo(material->bind(surface, normalize(view)), transport);
              if (!(m.mean() <= 1 + 4 * m.error() + 1e-4))
                failures.add(fmt::format("{}, {}: {} ± {}", text(view), name(transport), m.mean(),
                                         m.error()));
            }
        }
  }

  TEST_CASE("what is lost in rough surfaces vanishes with the roughness") {
    const Surface surface = flat_surface();
    for (const char* type : {"roughconductor", "roughdielectric"})
      for (const char* distribution : {"ggx", "beckmann"})
        for (const bool visible : {true, false})
          for (const float z : {1.0f, 0.5f, 0.2f, -0.5f, -0.9f}) {
            if (z < 0 && type == std::string("roughconductor")) continue;
            const Vector3f wo(std::sqrt(1 - z * z), 0, z);
            double last = 0;
            for (const float alpha : {0.4f, 0.1f, 0.02f, 0.002f}) {
              const TestMaterial material(json{{"type", type},
                                               {"distribution", distribution},
                                               {"sample_visible", visible},
                                               {"alpha", alpha}});
              const double kept = albedo(material->bind(surface, wo), Transport::importance).mean();
              CAPTURE(alpha);
              CHECK(kept > last - 2e-3);
              last = kept;
            }
            CHECK(last == doctest::Approx(1).epsilon(2e-3));
          }
  }

  TEST_CASE("a white plastic keeps nearly all light") {
    const Surface surface = flat_surface();
    // The fit for diffuse light in the coat is off by some percent for unusual indices.
    for (const float eta : {1.2f, 1.5f, 1.8f}) {
      const TestMaterial material(json{{"type", "plastic"},
                                       {"int_ior", eta},
                                       {"ext_ior", 1},
                                       {"diffuse_reflectance", 1},
                                       {"nonlinear", true}});
      for (const float z : {1.0f, 0.6f, 0.2f}) {
        const Vector3f wo(std::sqrt(1 - z * z), 0, z);
        const double kept = albedo(material->bind(surface, wo), Transport::radiance).mean();
        CHECK(kept == doctest::Approx(1).epsilon(0.01));
      }
    }
  }
}
