// Every material against tables of Mitsuba 3's values: see reference/make_bsdf_tables.py.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include "math/sampler.h"
#include "support/bsdf_checks.h"
#include "support/statistics.h"

using namespace duet;
using namespace duet::test;
using nlohmann::json;

namespace {

/// The table has six digits; what is left are rounding errors of narrow lobes.
constexpr double kTableTolerance = 2e-4;

}  // namespace

TEST_SUITE("materials like Mitsuba's") {
  TEST_CASE("values for radiance and importance") {
    const Surface surface = flat_surface();
    int compared = 0;
    for (const json& c : mitsuba_cases()) {
      const TestMaterial material(c["bsdf"]);
      Failures failures(c["name"]);
      for_each_pair(c, [&](size_t row, const Vector3f& wo, const Vector3f& wi) {
        const Bsdf bsdf = material->bind(surface, wo);
        const Spectrum theirs = c.contains("value") ? to_spectrum(c["value"][row]) : Spectrum();
        const Spectrum ours = bsdf.eval(wi, Transport::radiance).value;
        ++compared;
        if (!close(ours, theirs, kTableTolerance))
          failures.add(fmt::format("row {}: {}, Mitsuba {}", row, text(ours), text(theirs)));
        // Here Mitsuba's importance is not the adjoint of its radiance; ours is.
        if (perturbs(c["bsdf"]) || c["bsdf"]["type"] == "principledthin" ||
            c["bsdf"]["type"] == "hair")
          return;
        const Spectrum adjoint =
            c.contains("importance") ? to_spectrum(c["importance"][row]) : theirs;
        const Spectrum importance = bsdf.eval(wi, Transport::importance).value;
        if (!close(importance, adjoint, kTableTolerance))
          failures.add(fmt::format("row {}, importance: {}, Mitsuba {}", row, text(importance),
                                   text(adjoint)));
      });
    }
    CHECK(compared > 4000);
  }

  TEST_CASE("densities, where directions are sampled in the same way") {
    const Surface surface = flat_surface();
    int compared = 0;
    for (const json& c : mitsuba_cases()) {
      if (!c.contains("pdf")) continue;
      // We weigh the two lobes of coloured glass by their colours.
      const json& description = c["bsdf"];
      if (mentions(description, "specular_transmittance")) continue;
      const TestMaterial material(description);
      // Mitsuba's density of visible Beckmann normals is approximate, ours exact.
      const bool beckmann = mentions(description, "distribution", "beckmann") &&
                            !mentions(description, "sample_visible", false);
      // So is its density of hair, by the Bessel function.
      const double tolerance = beckmann                        ? 4e-3
                               : description["type"] == "hair" ? 8e-3
                                                               : kTableTolerance;
      Failures failures(c["name"]);
      for_each_pair(c, [&](size_t row, const Vector3f& wo, const Vector3f& wi) {
        // Below an opaque principled material there is a density, but nothing is sampled.
        if (description["type"] == "principled" && !description.contains("spec_trans") && wo.z < 0)
          return;
        const double ours =
            double(material->bind(surface, wo).eval(wi, Transport::radiance).pdf.value);
        const double theirs = c["pdf"][row];
        ++compared;
        if (!close(ours, theirs, tolerance))
          failures.add(fmt::format("row {}: {}, Mitsuba {}", row, ours, theirs));
      });
    }
    CHECK(compared > 3500);
  }

  TEST_CASE("delta lobes") {
    const Surface surface = flat_surface();
    int compared = 0;
    for (const json& c : mitsuba_cases()) {
      if (!c.contains("lobes")) continue;
      const TestMaterial material(c["bsdf"]);
      for (size_t k = 0; k < c["views"].size(); ++k) {
        const Bsdf bsdf = material->bind(surface, to_vector(c["views"][k]));
        std::vector<BsdfSample> found;
        for (int i = 0; i < 1000; ++i) {
          const auto s = bsdf.sample((float(i) + 0.5f) * 1e-3f, {0.3f, 0.6f}, Transport::radiance);
          if (!s || !s->delta || s->weight.is_black()) continue;
          const auto same = [&](const BsdfSample& other) { return other.wi == s->wi; };
          if (std::none_of(found.begin(), found.end(), same)) found.push_back(*s);
        }
        const json& lobes = c["lobes"][k];
        CAPTURE(c["name"].get<std::string>());
        CAPTURE(k);
        CHECK(found.size() == lobes.size());
        for (const json& lobe : lobes) {
          bool matched = false;
          for (const BsdfSample& s : found)
            matched |= length(s.wi - to_vector(lobe[0])) < 1e-4f &&
                       close(s.weight * s.pdf.value, to_spectrum(lobe[1]), kTableTolerance);
          CHECK(matched);
          ++compared;
        }
      }
    }
    CHECK(compared > 40);
  }

  TEST_CASE("albedos of all lobes together") {
    const Surface surface = flat_surface();
    const int samples = 40000;
    int compared = 0;
    for (const json& c : mitsuba_cases()) {
      if (!c.contains("albedo")) continue;
      const TestMaterial material(c["bsdf"]);
      Failures failures(c["name"]);
      for (size_t k = 0; k < c["views"].size(); ++k) {
        const Bsdf bsdf = material->bind(surface, to_vector(c["views"][k]));
        Moments moments[3];
        Sampler sampler(SampleSequence::sobol, 7, uint32_t(k), 0);
        for (int i = 0; i < samples; ++i) {
          sampler.start_sample(uint32_t(i));
          const Point2f v = sampler.next_2d();
          const auto s = bsdf.sample(sampler.next_1d(), v, Transport::radiance);
          for (int channel = 0; channel < 3; ++channel)
            moments[channel].add(s ? double(s->weight[channel]) : 0.0);
        }
        const Spectrum theirs = to_spectrum(c["albedo"][k][0]);
        const double error = c["albedo"][k][1];
        for (int channel = 0; channel < 3; ++channel) {
          const double mean = moments[channel].mean();
          // 0.4 %: Mitsuba samples Beckmann's visible normals not quite as its values say.
          const double tolerance = 4 * std::hypot(error, moments[channel].error()) +
                                   4e-3 * double(theirs[channel]) + 1e-5;
          ++compared;
          if (!(std::abs(mean - double(theirs[channel])) <= tolerance))
            failures.add(fmt::format("view {}, channel {}: {} ± {}, Mitsuba {}", k, channel, mean,
                                     moments[channel].error(), theirs[channel]));
        }
      }
    }
    CHECK(compared > 1000);
  }

  TEST_CASE("reflectances for the albedo layer") {
    const Surface surface = flat_surface();
    for (const json& c : mitsuba_cases()) {
      const TestMaterial material(c["bsdf"]);
      const Spectrum ours = material->albedo(surface, to_vector(c["views"][0]));
      const Spectrum theirs = to_spectrum(c["diffuse"]);
      CHECK_MESSAGE(close(ours, theirs, kTableTolerance), c["name"].get<std::string>(), ": ",
                    text(ours), ", Mitsuba ", text(theirs));
    }
  }
}
