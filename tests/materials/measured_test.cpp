// Measured materials: against Mitsuba's numbers, and their sampling against their density.
#include <doctest/doctest.h>

#include <cstring>

#include "materials/special_materials.h"
#include "math/sampler.h"
#include "math/statistics.h"
#include "math/warp.h"
#include "measured/measured_file.h"
#include "support/bsdf_checks.h"
#include "support/source_path.h"
#include "values/color.h"

using namespace duet;
using namespace duet::test;

namespace {

const MeasuredBrdf& brdf(bool anisotropic) {
  static const auto load = [](const char* name) {
    return MeasuredBrdf(std::make_shared<MeasuredTable>(
        read_measured(source_path("scenes/bsdf-measured/") + name)));
  };
  static const MeasuredBrdf first = load("isotropic.bsdf"), second = load("anisotropic.bsdf");
  return anisotropic ? second : first;
}

/// What Mitsuba 3.9.1 (scalar_rgb) says of the files of scenes/bsdf-measured, the first half for
/// the isotropic one.
struct Row {
  Vector3f wo, wi;
  Spectrum value;
  float pdf;
};
constexpr int kRows = 10;
const Row* rows() {
  static const Row table[kRows] = {
      {{0.3f, 0.2f, 0.8f}, {-0.3f, -0.1f, 0.9f}, {0.253484f, 0.168989f, 0.0844945f}, 1.84f},
      {{-0.5f, 0.4f, 0.3f}, {0.1f, 0.2f, 0.7f}, {0.088771f, 0.0591807f, 0.0295903f}, 0.00994486f},
      {{0.2f, -0.7f, 0.5f}, {-0.6f, 0.3f, 0.2f}, {0.0673767f, 0.0449178f, 0.0224589f}, 0.0155819f},
      {{-0.6f, -0.6f, 0.2f}, {0.7f, 0.5f, 0.3f}, {0.298851f, 0.199234f, 0.0996171f}, 0.359356f},
      {{0.0f, 0.1f, 1.0f}, {0.3f, -0.3f, 0.4f}, {0.0959828f, 0.0639885f, 0.0319943f}, 0.0632742f},
      {{0.3f, 0.2f, 0.8f}, {-0.3f, -0.1f, 0.9f}, {0.260592f, 0.173728f, 0.0868641f}, 1.77276f},
      {{-0.5f, 0.4f, 0.3f}, {0.1f, 0.2f, 0.7f}, {0.0866655f, 0.057777f, 0.0288885f}, 0.0180513f},
      {{0.2f, -0.7f, 0.5f}, {-0.6f, 0.3f, 0.2f}, {0.066401f, 0.0442673f, 0.0221337f}, 0.0211505f},
      {{-0.6f, -0.6f, 0.2f}, {0.7f, 0.5f, 0.3f}, {0.304442f, 0.202961f, 0.101481f}, 0.383604f},
      {{0.0f, 0.1f, 1.0f}, {0.3f, -0.3f, 0.4f}, {0.0919686f, 0.0613124f, 0.0306562f}, 0.081568f},
  };
  return table;
}

std::string bytes_of(const char* name) {
  ByteReader in(source_path("scenes/bsdf-measured/") + name);
  const size_t size = size_t(in.size());
  return {reinterpret_cast<const char*>(in.take(size, "it")), size};
}

MeasuredTable parse(const std::string& bytes) {
  ByteReader in("m.bsdf", {reinterpret_cast<const uint8_t*>(bytes.data()), bytes.size()});
  return parse_measured(in);
}

std::string error_of(const std::string& bytes) {
  try {
    parse(bytes);
  } catch (const ReadError& e) {
    return e.what();
  }
  return "";
}

/// A file of the table with spectra instead of colours.
std::string spectral_file(const MeasuredTable& t, const std::vector<float>& wavelengths,
                          const std::vector<float>& spectra) {
  struct Entry {
    std::string name;
    std::vector<uint64_t> shape;
    const std::vector<float>* values;
  };
  const uint64_t phis = t.phi.size(), thetas = t.theta.size();
  const auto grid = [](const MeasuredTable::Grid& g, std::vector<uint64_t> outer) {
    outer.push_back(g.size[1]), outer.push_back(g.size[0]);
    return outer;
  };
  const std::vector<Entry> entries{
      {"phi_i", {phis}, &t.phi},
      {"theta_i", {thetas}, &t.theta},
      {"wavelengths", {wavelengths.size()}, &wavelengths},
      {"ndf", grid(t.ndf, {}), &t.ndf.values},
      {"sigma", grid(t.sigma, {}), &t.sigma.values},
      {"vndf", grid(t.vndf, {phis, thetas}), &t.vndf.values},
      {"luminance", grid(t.luminance, {phis, thetas}), &t.luminance.values},
      {"spectra", grid(t.rgb, {phis, thetas, wavelengths.size()}), &spectra}};
  std::string head, body;
  const auto put = [](std::string& to, const auto& v) {
    to.append(reinterpret_cast<const char*>(&v), sizeof v);
  };
  const auto field = [&](const std::string& name, const std::vector<uint64_t>& shape, uint8_t type,
                         uint64_t offset) {
    put(head, uint16_t(name.size())), head += name, put(head, uint16_t(shape.size()));
    put(head, type), put(head, offset);
    for (const uint64_t n : shape) put(head, n);
  };
  // The places of the arrays are known once the header's length is.
  for (int round = 0; round < 2; ++round) {
    const uint64_t header = head.size();
    head.assign("tensor_file", 12), body.clear();
    put(head, uint8_t(1)), put(head, uint8_t(0)), put(head, uint32_t(entries.size() + 1));
    for (const Entry& e : entries) {
      field(e.name, e.shape, 10, header + body.size());
      for (const float v : *e.values) put(body, v);
    }
    field("jacobian", {1}, 1, header + body.size());
    put(body, uint8_t(t.has_jacobian));
  }
  return head + body;
}

}  // namespace

TEST_SUITE("measured materials") {
  TEST_CASE("values and densities are those of Mitsuba") {
    for (int i = 0; i < kRows; ++i) {
      const Row& r = rows()[i];
      const MeasuredModel model{&brdf(i >= kRows / 2)};
      const ModelEval e = model.eval(normalize(r.wo), normalize(r.wi), Transport::radiance);
      CAPTURE(i);
      CHECK_MESSAGE(close(e.value, r.value, 1e-3), text(e.value), ", Mitsuba ", text(r.value));
      CHECK_MESSAGE(close(double(e.pdf), double(r.pdf), 1e-3), e.pdf, ", Mitsuba ", r.pdf);
    }
  }

  TEST_CASE("what is sampled has the density") {
    // Means of smooth functions over samples, against their integrals with the density.
    for (const bool anisotropic : {false, true})
      for (const Transport transport : kTransports)
        for (const Vector3f& view : {Vector3f(0.3f, 0.2f, 0.8f), Vector3f(-0.5f, 0.4f, 0.3f)}) {
          const MeasuredModel model{&brdf(anisotropic)};
          const Vector3f wo = normalize(view);
          const auto g = [](const Vector3f& w, int k) {
            return k == 0 ? 1.0 : k == 1 ? double(w.x) : k == 2 ? double(w.y * w.y) : double(w.z);
          };
          Moments sampled[4], integral[4], values[4], integrated[4];
          Sampler sampler(SampleSequence::sobol, 3, 1, 0);
          constexpr int kSamples = 1 << 17;
          for (int i = 0; i < kSamples; ++i) {
            sampler.start_sample(uint32_t(i));
            const auto s = model.sample(wo, 0, sampler.next_2d(), transport);
            const Vector3f w = square_to_cosine_hemisphere(sampler.next_2d());
            const ModelEval e = model.eval(wo, w, transport);
            const double inverse = w.z > 0 ? kPi / double(w.z) : 0;
            for (int k = 0; k < 4; ++k) {
              sampled[k].add(s ? g(s->wi, k) : 0.0);
              integral[k].add(double(e.pdf) * inverse * g(w, k));
              values[k].add(s ? double(s->weight.g) * g(s->wi, k) : 0.0);
              integrated[k].add(double(e.value.g) * inverse * g(w, k));
            }
          }
          for (int k = 0; k < 4; ++k) {
            CAPTURE(anisotropic);
            CAPTURE(name(transport));
            CAPTURE(k);
            CHECK(std::abs(sampled[k].mean() - integral[k].mean()) <
                  5 * std::hypot(sampled[k].error(), integral[k].error()));
            CHECK(std::abs(values[k].mean() - integrated[k].mean()) <
                  5 * std::hypot(values[k].error(), integrated[k].error()));
          }
        }
  }

  TEST_CASE("a warp and its inverse") {
    MeasuredTable::Grid grid;
    grid.size = {4, 3};
    grid.values = {1, 2, 0, 1, 3, 1, 1, 0.5f, 0, 2, 1, 4, 2, 2, 2, 2, 1, 0, 3, 1, 1, 1, 1, 1};
    const std::vector<float> first{0}, second{0, 1};
    const WarpGrid warp(grid, first, second);
    for (const float weight : {0.0f, 0.3f, 1.0f})
      for (int i = 0; i < 50; ++i) {
        const Point2f u{0.01f + 0.0193f * float(i), 0.99f - 0.0187f * float(i)};
        const WarpGrid::Mix mix = warp.mix(0, weight);
        float a, b;
        const Point2f p = warp.sample(mix, u, a);
        const Point2f back = warp.invert(mix, p, b);
        CHECK(back.x == doctest::Approx(u.x).epsilon(1e-3));
        CHECK(back.y == doctest::Approx(u.y).epsilon(1e-3));
        CHECK(a == doctest::Approx(b).epsilon(1e-3));
        CHECK(warp.density(mix, p) == doctest::Approx(b).epsilon(1e-3));
      }
  }

  TEST_CASE("files that are not what they should be") {
    const std::string good = bytes_of("isotropic.bsdf");
    CHECK(error_of(good).empty());
    CHECK(error_of("tensor") == "m.bsdf: is not a measured material (a tensor file)");
    CHECK(error_of(good.substr(0, good.size() - 2000)).find("ends in the middle of the field") !=
          std::string::npos);
    std::string other = good;
    other[12] = 2;
    CHECK(error_of(other) == "m.bsdf: is of version 2.0; only 1.0 is known");
    std::string spectral = good;
    spectral.replace(spectral.find("rgb"), 3, "xyz");
    CHECK(error_of(spectral) == "m.bsdf: has no field \"rgb\"");
    std::string negative = good;
    const MeasuredTable table = parse(good);
    const float value = table.vndf.values[7];
    char bytes[4];
    std::memcpy(bytes, &value, 4);
    const size_t at = negative.find(std::string(bytes, 4));
    REQUIRE(at != std::string::npos);
    negative[at + 3] = char(negative[at + 3] | 0x80);
    CHECK(error_of(negative).find("the field \"vndf\" has the value -") != std::string::npos);
  }

  TEST_CASE("spectra become the colours that they have under daylight") {
    MeasuredTable t = parse(bytes_of("isotropic.bsdf"));
    // Straight lines from 400 nm to 800 nm, another one at each node.
    const std::vector<float> wavelengths{360, 400, 500, 600, 700, 800, 830};
    std::vector<float> spectra;
    const size_t nodes = t.rgb.nodes(), count = wavelengths.size();
    const auto value = [&](size_t i, size_t w) {
      return t.rgb.values[i] * (1 + 0.1f * float(w)) / (1 + 0.001f * float(i));
    };
    for (size_t d = 0; d < t.phi.size() * t.theta.size(); ++d)
      for (size_t w = 0; w < count; ++w)
        for (size_t i = 0; i < nodes; ++i) spectra.push_back(value(d * 3 * nodes + i, w));
    const MeasuredTable read = parse(spectral_file(t, wavelengths, spectra));
    CHECK(read.vndf == t.vndf);
    CHECK(read.rgb.size == t.rgb.size);
    REQUIRE(read.rgb.values.size() == t.rgb.values.size());
    for (size_t d = 0; d < t.phi.size() * t.theta.size(); ++d)
      for (size_t i = 0; i < nodes; i += 7) {
        std::vector<SpectrumSample> samples;
        for (size_t w = 0; w < count; ++w)
          samples.push_back({double(wavelengths[w]), double(value(d * 3 * nodes + i, w))});
        const Spectrum expected = spectrum_to_rgb(samples, ColorMeaning::unbounded);
        for (size_t c = 0; c < 3; ++c)
          CHECK(double(read.rgb.values[(d * 3 + c) * nodes + i]) ==
                doctest::Approx(double(expected[int(c)])).epsilon(1e-3).scale(0.01));
      }
  }
}
