// Every material against tables of Mitsuba 3's values: see reference/make_bsdf_tables.py.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include "materials/test_material.h"
#include "math/sampler.h"
#include "support/statistics.h"

using namespace duet;
using duet::test::TestMaterial;
using nlohmann::json;

namespace {

const json& cases() {
  return test::mitsuba_tables()["cases"];
}

/// Whether the description or one nested in it has a key with this value, or of this name at all.
bool mentions(const json& bsdf, const char* key, const json& value = {}) {
  if (bsdf.contains(key) && (value.is_null() || bsdf[key] == value)) return true;
  if (bsdf.contains("nested"))
    for (const json& n : bsdf["nested"])
      if (mentions(n, key, value)) return true;
  return false;
}

bool perturbs(const json& bsdf) {
  return mentions(bsdf, "type", "normalmap") || mentions(bsdf, "type", "bumpmap");
}

/// Calls f(row, wo, wi) for the direction pairs of a case.
template <class F>
void for_each_pair(const json& c, const F& f) {
  size_t row = 0;
  for (const json& set : c["pairs"])
    for (const json& pair : test::mitsuba_tables()["pairs"][set.get<std::string>()])
      f(row++, test::to_vector(pair[0]), test::to_vector(pair[1]));
}

/// Tables have six digits; what is left are rounding errors of narrow lobes.
bool close(double ours, double theirs, double relative = 2e-4) {
  return std::abs(ours - theirs) <= relative * std::abs(theirs) + 1e-6;
}

bool close(const Spectrum& ours, const Spectrum& theirs, double relative = 2e-4) {
  for (int c = 0; c < 3; ++c)
    if (!close(double(ours[c]), double(theirs[c]), relative)) return false;
  return true;
}

std::string text(const Spectrum& s) {
  return fmt::format("({}, {}, {})", s.r, s.g, s.b);
}

/// Reports the first failure of each case and how many there are.
class Failures {
 public:
  explicit Failures(const std::string& name) : name_(name) {}
  ~Failures() { CHECK_MESSAGE(count_ == 0, name_, ": ", count_, " differ, first ", first_); }
  void add(const std::string& what) {
    if (count_++ == 0) first_ = what;
  }

 private:
  std::string name_, first_;
  int count_ = 0;
};

}  // namespace

TEST_SUITE("materials like Mitsuba's") {
  TEST_CASE("values for radiance and importance") {
    const Surface surface = test::flat_surface();
    int compared = 0;
    for (const json& c : cases()) {
      const TestMaterial material(c["bsdf"]);
      Failures failures(c["name"]);
      for_each_pair(c, [&](size_t row, const Vector3f& wo, const Vector3f& wi) {
        const Bsdf bsdf = material->bind(surface, wo);
        const Spectrum theirs =
            c.contains("value") ? test::to_spectrum(c["value"][row]) : Spectrum();
        const Spectrum ours = bsdf.eval(wi, Transport::radiance).value;
        ++compared;
        if (!close(ours, theirs))
          failures.add(fmt::format("row {}: {}, Mitsuba {}", row, text(ours), text(theirs)));
        // Under bump maps Mitsuba's importance is not the adjoint of its radiance; ours is.
        if (perturbs(c["bsdf"])) return;
        const Spectrum adjoint =
            c.contains("importance") ? test::to_spectrum(c["importance"][row]) : theirs;
        const Spectrum importance = bsdf.eval(wi, Transport::importance).value;
        if (!close(importance, adjoint))
          failures.add(fmt::format("row {}, importance: {}, Mitsuba {}", row, text(importance),
                                   text(adjoint)));
      });
    }
    CHECK(compared > 4000);
  }

  TEST_CASE("densities, where directions are sampled in the same way") {
    const Surface surface = test::flat_surface();
    int compared = 0;
    for (const json& c : cases()) {
      if (!c.contains("pdf")) continue;
      // We weigh the two lobes of coloured glass by their colours.
      const json& description = c["bsdf"];
      if (mentions(description, "specular_transmittance")) continue;
      const TestMaterial material(description);
      // Mitsuba's density of visible Beckmann normals is approximate, ours exact.
      const bool beckmann = mentions(description, "distribution", "beckmann") &&
                            !mentions(description, "sample_visible", false);
      const double tolerance = beckmann ? 4e-3 : 2e-4;
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
    const Surface surface = test::flat_surface();
    int compared = 0;
    for (const json& c : cases()) {
      if (!c.contains("lobes")) continue;
      const TestMaterial material(c["bsdf"]);
      for (size_t k = 0; k < c["views"].size(); ++k) {
        const Bsdf bsdf = material->bind(surface, test::to_vector(c["views"][k]));
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
            matched |= length(s.wi - test::to_vector(lobe[0])) < 1e-4f &&
                       close(s.weight * s.pdf.value, test::to_spectrum(lobe[1]));
          CHECK(matched);
          ++compared;
        }
      }
    }
    CHECK(compared > 40);
  }

  TEST_CASE("albedos of all lobes together") {
    const Surface surface = test::flat_surface();
    const int samples = 40000;
    int compared = 0;
    for (const json& c : cases()) {
      if (!c.contains("albedo")) continue;
      const TestMaterial material(c["bsdf"]);
      Failures failures(c["name"]);
      for (size_t k = 0; k < c["views"].size(); ++k) {
        const Bsdf bsdf = material->bind(surface, test::to_vector(c["views"][k]));
        test::Moments moments[3];
        Sampler sampler(SampleSequence::sobol, 7, uint32_t(k), 0);
        for (int i = 0; i < samples; ++i) {
          sampler.start_sample(uint32_t(i));
          const Point2f v = sampler.next_2d();
          const auto s = bsdf.sample(sampler.next_1d(), v, Transport::radiance);
          for (int channel = 0; channel < 3; ++channel)
            moments[channel].add(s ? double(s->weight[channel]) : 0.0);
        }
        const Spectrum theirs = test::to_spectrum(c["albedo"][k][0]);
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
    const Surface surface = test::flat_surface();
    for (const json& c : cases()) {
      const TestMaterial material(c["bsdf"]);
      const Spectrum ours = material->albedo(surface, test::to_vector(c["views"][0]));
      const Spectrum theirs = test::to_spectrum(c["diffuse"]);
      CHECK_MESSAGE(close(ours, theirs), c["name"].get<std::string>(), ": ", text(ours),
                    ", Mitsuba ", text(theirs));
    }
  }
}
