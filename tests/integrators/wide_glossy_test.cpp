// Glossy and specular materials in lanes give what their Bsdf gives, bit for bit.
#include <doctest/doctest.h>

#include "integrators/wide_conductor.h"
#include "integrators/wide_dielectric.h"
#include "integrators/wide_plastic.h"
#include "integrators/wide_principled.h"
#include "integrators/wide_specular.h"
#include "materials/principled_materials.h"
#include "math/sampler.h"
#include "support/test_material.h"

using namespace duet;
using namespace duet::test;

namespace {

const char* const kPlastics[] = {
    R"({"type": "roughplastic", "distribution": "ggx", "alpha": 0.3})",
    R"({"type": "roughplastic", "alpha": 0.1, "diffuse_reflectance": [0.2, 0.5, 0.8]})",
    R"({"type": "roughplastic", "alpha": 0.6, "nonlinear": true, "int_ior": 1.9})",
    R"({"type": "roughplastic", "alpha": 0.02, "int_ior": 1.0, "ext_ior": 1.4})",
    R"({"type": "roughplastic", "diffuse_reflectance": [0, 0, 0]})",
};
const char* const kSmoothPlastics[] = {
    R"({"type": "plastic"})",
    R"({"type": "plastic", "diffuse_reflectance": [0.2, 0.5, 0.8], "nonlinear": true,
        "specular_reflectance": [0.9, 0.5, 0.2], "int_ior": 1.9})",
    R"({"type": "plastic", "int_ior": 1.0, "ext_ior": 1.4})",
    R"({"type": "plastic", "diffuse_reflectance": [0, 0, 0]})",
};
const char* const kConductors[] = {
    R"({"type": "roughconductor", "distribution": "ggx", "alpha": 0.3, "eta": [0.2, 0.9, 1.4],
        "k": [3.9, 2.4, 2.1]})",
    R"({"type": "roughconductor", "alpha": 0.1, "eta": [0.2, 0.9, 1.4], "k": [3.9, 2.4, 2.1],
        "specular_reflectance": [0.9, 0.5, 0.2]})",
    R"({"type": "roughconductor", "alpha": 0.9, "eta": [0, 0.9, 0], "k": [0, 0, 2]})",
    R"({"type": "roughconductor", "alpha": 0.0001, "eta": [0, 0, 0], "k": [1, 1, 1]})",
    R"({"type": "roughconductor", "distribution": "ggx", "eta": [0, 0, 0], "k": [0, 0, 0]})",
};

const char* const kPrincipled[] = {
    R"({"type": "principled"})",
    R"({"type": "principled", "base_color": [0.2, 0.5, 0.8], "roughness": 0.1, "metallic": 0.6,
        "spec_tint": 0.4, "eta": 1.8})",
    R"({"type": "principled", "base_color": [0.9, 0.5, 0.1], "roughness": 0.7, "sheen": 0.9,
        "sheen_tint": 0.3, "flatness": 0.8, "eta": 0.7})",
    R"({"type": "principled", "base_color": [0, 0, 0], "metallic": 1, "eta": 1})",
    R"({"type": "principled", "metallic": 0.5, "roughness": 0, "eta": 1.01})",
};

const char* const kRoughDielectrics[] = {
    R"({"type": "roughdielectric", "distribution": "ggx", "alpha": 0.3})",
    R"({"type": "roughdielectric", "alpha": 0.1, "int_ior": 1.0, "ext_ior": 1.9})",
    R"({"type": "roughdielectric", "alpha": 0.6, "specular_reflectance": [0.9, 0.5, 0.2],
        "specular_transmittance": [0.1, 0.5, 0.8]})",
    R"({"type": "roughdielectric", "distribution": "ggx", "alpha": 0.02,
        "specular_transmittance": [0, 0, 0]})",
    R"({"type": "roughdielectric", "alpha": 0.0001})",
};
const char* const kSpecular[] = {
    R"({"type": "dielectric"})",
    R"({"type": "dielectric", "int_ior": 1.0, "ext_ior": 1.9,
        "specular_reflectance": [0.9, 0.5, 0.2], "specular_transmittance": [0.1, 0.5, 0.8]})",
    R"({"type": "dielectric", "int_ior": 1.3, "ext_ior": 1.3})",
    R"({"type": "dielectric", "specular_transmittance": [0, 0, 0]})",
    R"({"type": "dielectric", "specular_reflectance": [0, 0, 0],
        "specular_transmittance": [0, 0, 0]})",
    R"({"type": "thindielectric"})",
    R"({"type": "thindielectric", "int_ior": 1.9, "specular_reflectance": [0.9, 0.5, 0.2],
        "specular_transmittance": [0.1, 0.5, 0.8]})",
    R"({"type": "conductor", "eta": [0.2, 0.9, 1.4], "k": [3.9, 2.4, 2.1],
        "specular_reflectance": [0.9, 0.5, 0.2]})",
    R"({"type": "twosided", "nested": [{"type": "conductor", "eta": [0.2, 0.9, 1.4],
        "k": [3.9, 2.4, 2.1]}]})",
};

std::string two_sided(const std::string& bsdf) {
  return R"({"type": "twosided", "nested": [)" + bsdf + "]}";
}

/// Points of one material with directions to where paths come from, to lights and random numbers.
struct Points {
  WidePaths paths{};
  WidePoints points{};
  WideNumbers numbers{};
  BatchTriples light{};
  WideGlossy out{};
  int count = 0;

  Points(const Spectrum& reflectance, uint64_t seed) {
    Sampler sampler(SampleSequence::independent, seed, 0, 0);
    // Every third point is left out, and those seen along their normals are among them.
    for (int i = 0; i < kBatch; ++i) {
      sampler.start_sample(uint32_t(i));
      const Vector3f n = square_to_sphere(sampler.next_2d());
      const Vector3f wo = square_to_sphere(sampler.next_2d());
      points.ns.set(i, n);
      paths.ray.direction.set(i, i % 16 == 0 ? -n : -wo);
      light.set(i, square_to_sphere(sampler.next_2d()));
      points.reflectance.set(i, reflectance.r, reflectance.g, reflectance.b);
      const Point2f v = sampler.next_2d();
      numbers.x[i] = v.x, numbers.y[i] = v.y;
      numbers.first[i] = sampler.next_1d(), numbers.second[i] = sampler.next_1d();
      if (i % 3 != 0) {
        out.towards.set(count, light.vector(i));
        out.at[count++] = i;
      }
    }
    numbers.x[16] = numbers.y[16] = 0;
    numbers.x[17] = numbers.y[17] = kBelowOne;
  }
};

/// The material at the point of the k-th of what was made.
Bsdf bind(const Material& material, const Points& p, int k) {
  const int i = p.out.at[k];
  Surface surface = flat_surface();
  surface.shading = Frame(p.points.ns.normal(i));
  return material.bind(surface, -p.paths.ray.direction.vector(i));
}

/// Checks the k-th direction that was sampled; returns the one of the Bsdf if the path goes on.
std::optional<BsdfSample> check_sample(const Bsdf& bsdf, const Points& p, int k,
                                       Transport transport) {
  const int i = p.out.at[k];
  const bool chooses = bsdf.needs_choice();
  const auto s =
      bsdf.sample(chooses ? p.numbers.first[i] : 0.5f, {p.numbers.x[i], p.numbers.y[i]}, transport);
  CHECK(p.out.roulette[k] == (chooses ? p.numbers.second[i] : p.numbers.first[i]));
  CHECK(s.has_value() == (p.out.alive[k] != 0));
  if (!s || !p.out.alive[k]) return std::nullopt;
  CHECK(s->wi == p.out.wi.vector(k));
  CHECK(s->weight == Spectrum(p.out.weight.x[k], p.out.weight.y[k], p.out.weight.z[k]));
  CHECK((s->delta ? -1.0f : s->pdf.value) == p.out.pdf[k]);
  return s;
}

/// Checks the k-th of what was made. Returns whether a path goes on from it.
bool check_point(const Material& material, const Points& p, int k, Transport transport) {
  const int i = p.out.at[k];
  CAPTURE(i);
  const Bsdf bsdf = bind(material, p, k);
  const BsdfEval e = bsdf.eval(p.light.vector(i), transport);
  CHECK(e.value == Spectrum(p.out.value.x[k], p.out.value.y[k], p.out.value.z[k]));
  CHECK(e.pdf.value == p.out.value_pdf[k]);
  if (!e.value.is_black())
    CHECK(bsdf.reverse_pdf(p.light.vector(i), transport).value == p.out.reverse[k]);
  const auto s = check_sample(bsdf, p, k, transport);
  if (s && material.transmits())
    CHECK(p.out.eta[k] == (transport == Transport::radiance ? s->eta : 1.0f));
  return s.has_value();
}

/// The same of specular materials.
bool check_specular_point(const Material& material, const Points& p, int k, Transport transport) {
  const int i = p.out.at[k];
  CAPTURE(i);
  const auto s = check_sample(bind(material, p, k), p, k, transport);
  if (!s) return false;
  CHECK(s->null == (p.out.null[k] != 0));
  CHECK((s->delta && p.out.pdf[k] < 0));
  CHECK((transport == Transport::radiance ? s->eta : 1.0f) == p.out.eta[k]);
  const Normal3f n = p.points.ns.normal(i);
  const Vector3f wo = -p.paths.ray.direction.vector(i);
  const float refracted = std::abs(dot(n, wo) / (dot(n, s->wi) * s->eta * s->eta));
  CHECK(p.out.reverse[k] == doctest::Approx(s->eta == 1 ? 1 : refracted).epsilon(1e-3));
  return true;
}

void compare_specular(const std::string& description, Transport transport) {
  CAPTURE(description);
  const TestMaterial material(nlohmann::json::parse(description));
  const auto surface = as_specular(*material);
  REQUIRE(surface);
  int alive = 0;
  for (uint64_t seed = 0; seed < 20; ++seed) {
    CAPTURE(seed);
    Points p(Spectrum(0), seed);
    sample_specular(p.count, *surface, {p.paths, p.points, p.numbers, transport}, p.out);
    for (int k = 0; k < p.count; ++k) alive += check_specular_point(*material, p, k, transport);
  }
  const bool black = description.find("reflectance\": [0, 0, 0]") != std::string::npos;
  CHECK((black ? alive == 0 : alive > 500));
}

/// `as_surface` makes a material that which is scattered in lanes; `reflectance_of` what of that
/// may depend on the point.
template <class AsSurface, class ReflectanceOf>
void compare(const std::string& description, AsSurface&& as_surface, ReflectanceOf&& reflectance_of,
             Transport transport = Transport::radiance) {
  CAPTURE(description);
  const TestMaterial material(nlohmann::json::parse(description));
  const auto surface = as_surface(*material);
  REQUIRE(surface);
  int alive = 0;
  for (uint64_t seed = 0; seed < 20; ++seed) {
    CAPTURE(seed);
    Points p(reflectance_of(*surface).constant, seed);
    const WideVertices vertices{p.paths, p.points, p.numbers, transport};
    evaluate_glossy(p.count, *surface, vertices, p.out);
    reverse_glossy(p.count, *surface, vertices, p.out);
    sample_glossy(p.count, *surface, vertices, p.out);
    for (int k = 0; k < p.count; ++k) alive += check_point(*material, p, k, transport);
  }
  CHECK(alive > 500);
}

void compare_plastic(const std::string& description) {
  compare(description, as_rough_plastic,
          [](const RoughPlasticSurface& s) -> const ColorSlot& { return s.base; });
}

void compare_smooth_plastic(const std::string& description) {
  compare(description, as_plastic,
          [](const PlasticSurface& s) -> const ColorSlot& { return s.base; });
}

void compare_dielectric(const std::string& description, Transport transport) {
  static const ColorSlot none{Spectrum(0)};
  compare(
      description, as_rough_dielectric,
      [](const RoughDielectricSurface&) -> const ColorSlot& { return none; }, transport);
}

void compare_conductor(const std::string& description) {
  compare(description, as_rough_conductor,
          [](const RoughConductorSurface& s) -> const ColorSlot& { return s.reflectance; });
}

void compare_principled(const std::string& description) {
  compare(description, as_principled,
          [](const PrincipledSurface& s) -> const ColorSlot& { return s.base_color; });
}

}  // namespace

TEST_CASE("rough plastics in lanes are what their Bsdf is") {
  for (const std::string bsdf : kPlastics) {
    compare_plastic(bsdf);
    compare_plastic(two_sided(bsdf));
  }
}

TEST_CASE("smooth plastics in lanes are what their Bsdf is") {
  for (const std::string bsdf : kSmoothPlastics) {
    compare_smooth_plastic(bsdf);
    compare_smooth_plastic(two_sided(bsdf));
  }
}

TEST_CASE("rough conductors in lanes are what their Bsdf is") {
  for (const std::string bsdf : kConductors) {
    compare_conductor(bsdf);
    compare_conductor(two_sided(bsdf));
  }
}

TEST_CASE("Burley's materials in lanes are what their Bsdf is") {
  for (const std::string bsdf : kPrincipled) {
    compare_principled(bsdf);
    compare_principled(two_sided(bsdf));
  }
  for (const char* description :
       {R"({"type": "principled", "clearcoat": 0.1})",
        R"({"type": "principled", "spec_trans": 0.1})",
        R"({"type": "principled", "anisotropic": 0.1})", R"({"type": "principledthin"})"})
    CHECK(!as_principled(*TestMaterial(description)));
  const FlatTexture map(Spectrum(0.5f));
  PrincipledOptions textured;
  textured.base_color.texture = &map;
  CHECK(as_principled(Principled(textured)));
  textured.roughness.texture = &map;
  CHECK(!as_principled(Principled(textured)));
}

TEST_CASE("rough dielectrics in lanes are what their Bsdf is") {
  for (const std::string bsdf : kRoughDielectrics)
    for (const Transport transport : {Transport::radiance, Transport::importance})
      compare_dielectric(bsdf, transport);
  for (const char* description : {R"({"type": "roughdielectric", "sample_visible": false})",
                                  R"({"type": "roughdielectric", "int_ior": 1.3, "ext_ior": 1.3})",
                                  R"({"type": "dielectric"})"})
    CHECK(!as_rough_dielectric(*TestMaterial(description)));
}

TEST_CASE("specular materials in lanes are what their Bsdf is") {
  for (const std::string bsdf : kSpecular)
    for (const Transport transport : {Transport::radiance, Transport::importance})
      compare_specular(bsdf, transport);
}

TEST_CASE("what has smooth lobes, covers or textures is not specular") {
  for (const char* description :
       {R"({"type": "roughdielectric"})", R"({"type": "plastic"})", R"({"type": "null"})",
        R"({"type": "mask", "opacity": 0.5, "nested": [{"type": "dielectric"}]})"})
    CHECK(!as_specular(*TestMaterial(description)));
  const FlatTexture tint(Spectrum(0.5f));
  DielectricOptions options;
  options.specular_transmittance.texture = &tint;
  CHECK(!as_specular(Dielectric(options)));
}

TEST_CASE("what has other facets or an index from a texture is not scattered in lanes") {
  for (const char* description :
       {R"({"type": "roughconductor", "sample_visible": false})", R"({"type": "conductor"})",
        R"({"type": "roughplastic"})", R"({"type": "diffuse"})"})
    CHECK(!as_rough_conductor(*TestMaterial(description)));
  for (const char* description : {R"({"type": "roughplastic", "sample_visible": false})",
                                  R"({"type": "plastic"})", R"({"type": "roughconductor"})"})
    CHECK(!as_rough_plastic(*TestMaterial(description)));
  const FlatTexture eta(Spectrum(0.5f));
  ConductorOptions options;
  options.eta.texture = &eta;
  CHECK(!as_rough_conductor(RoughConductor(options, {})));
  const FlatTexture alpha(Spectrum(0.5f));
  RoughnessOptions rough;
  rough.alpha_u.texture = rough.alpha_v.texture = &alpha;
  CHECK(!as_rough_conductor(RoughConductor({}, rough)));
  RoughnessOptions correlated;
  correlated.distribution = MicrofacetDistribution::ggx_correlated;
  CHECK(!as_rough_conductor(RoughConductor({}, correlated)));
  CHECK(as_rough_conductor(RoughConductor({}, {})));
}
