// Nanoseconds per call of each scattering model, on one core: the cost that shading adds to
// tracing.
//
//   duet_bench [CALLS] [NAME]     default: 1000000 calls; NAME restricts to models that contain it
#include <fmt/format.h>

#include <cstdlib>
#include <string>
#include <vector>

#include "cpu_time.h"
#include "materials/principled_materials.h"
#include "materials/wrappers.h"
#include "math/sampler.h"

using namespace duet;

namespace {

/// Directions and numbers in random order: too many for the branch predictor to learn them by
/// heart.
constexpr size_t kInputs = 4096;
/// Bound materials: few enough to stay in the first cache.
constexpr size_t kBound = 16;

struct Inputs {
  std::vector<Vector3f> wo, wi;
  std::vector<float> u;
  std::vector<Point2f> v;

  /// With `both_sides` half of the wi lie below the surface.
  explicit Inputs(bool both_sides) {
    Sampler sampler(SampleSequence::independent, 1, 0, 0);
    for (uint32_t i = 0; i < kInputs; ++i) {
      sampler.start_sample(i);
      wo.push_back(square_to_cosine_hemisphere(sampler.next_2d()));
      wi.push_back(square_to_cosine_hemisphere(sampler.next_2d()));
      if (both_sides && i % 2) wi.back().z *= -1;
      v.push_back(sampler.next_2d());
      u.push_back(sampler.next_1d());
    }
  }
};

/// Results go here, so that the compiler cannot leave out the work.
volatile float sink;

/// Nanoseconds per call: the fastest of a few rounds, so that other programs count less.
template <class F>
double time_calls(int calls, const F& f) {
  constexpr int kRounds = 20;
  const int per_round = std::max(calls / kRounds, 1);
  double best = 1e300;
  for (int round = 0; round < kRounds; ++round) {
    float sum = 0;
    const double start = cpu_seconds(CLOCK_THREAD_CPUTIME_ID);
    for (int i = 0; i < per_round; ++i) sum += f(size_t(i) % kInputs);
    const double seconds = cpu_seconds(CLOCK_THREAD_CPUTIME_ID) - start;
    best = std::min(best, seconds * 1e9 / per_round);
    sink = sum;
  }
  return best;
}

void measure(const std::string& name, const Material& material, int calls) {
  const Inputs in(material.transmits());
  Surface surface{};
  surface.shading = Frame(normalize(Normal3f(0.1f, 0.2f, 1)));
  surface.ng = surface.shading.n;
  surface.dp_du = surface.shading.s, surface.dp_dv = surface.shading.t;
  std::vector<Bsdf> bound;
  std::vector<Vector3f> wi;
  for (size_t i = 0; i < kBound; ++i)
    bound.push_back(material.bind(surface, surface.shading.to_world(in.wo[i])));
  for (const Vector3f& w : in.wi) wi.push_back(surface.shading.to_world(w));
  const double bind = time_calls(calls, [&](size_t i) {
    const Bsdf b = material.bind(surface, wi[i]);
    asm volatile("" : : "r"(&b) : "memory");  // as if all of it were read
    return 0.0f;
  });
  const double eval = time_calls(calls, [&](size_t i) {
    const BsdfEval e = bound[i % kBound].eval(wi[i], Transport::radiance);
    return e.value.g + e.pdf.value;
  });
  const double sample = time_calls(calls, [&](size_t i) {
    const auto s = bound[i % kBound].sample(in.u[i], in.v[i], Transport::radiance);
    return s ? s->weight.g + s->wi.x : 0.0f;
  });
  fmt::print("{:<34}{:8.1f}{:8.1f}{:8.1f}\n", name, bind, eval, sample);
}

/// A texture that costs nothing but its call.
class FlatTexture final : public Texture {
 public:
  Spectrum color(const Surface& s) const override { return {0.5f, 0.4f, 0.5f + s.offset}; }
  float value(const Surface&) const override { return 0.5f; }
  Point2f gradient(const Surface&) const override { return {0.1f, 0.2f}; }
  Spectrum average() const override { return Spectrum(0.5f); }
};

}  // namespace

int main(int argc, char** argv) {
  const int calls = argc > 1 ? std::atoi(argv[1]) : 1000000;
  const std::string only = argc > 2 ? argv[2] : "";
  if (calls < 1) {
    fmt::print(stderr, "usage: duet_bench [CALLS] [NAME]\n");
    return 2;
  }
  const FlatTexture texture;
  const ColorSlot textured{{}, &texture};
  RoughnessOptions ggx, beckmann, brushed;
  ggx.distribution = brushed.distribution = MicrofacetDistribution::ggx;
  brushed.alpha_v.constant = 0.3f;
  RoughnessOptions all_normals = ggx;
  all_normals.sample_visible = false;
  ConductorOptions gold;
  gold.eta = {Spectrum(0.143f, 0.375f, 1.442f)};
  gold.k = {Spectrum(3.983f, 2.386f, 1.603f)};
  PlasticOptions paint;
  paint.diffuse_reflectance = textured;
  PrincipledOptions all_lobes;
  all_lobes.clearcoat = all_lobes.spec_trans = all_lobes.metallic = all_lobes.sheen = {0.3f};

  fmt::print("{:<34}{:>8}{:>8}{:>8}   ns per call\n", "", "bind", "eval", "sample");
  const auto run = [&](const char* name, const Material& m) {
    if (std::string(name).find(only) != std::string::npos) measure(name, m, calls);
  };
  const Diffuse diffuse({Spectrum(0.5f)});
  const RoughPlastic plastic(paint, ggx);
  const Conductor mirror({});
  run("diffuse", diffuse);
  run("diffuse, textured", Diffuse(textured));
  run("diffuse, twosided", TwoSided(diffuse, diffuse));
  run("conductor, gold", Conductor(gold));
  run("roughconductor ggx", RoughConductor({}, ggx));
  run("roughconductor ggx, gold", RoughConductor(gold, ggx));
  run("roughconductor ggx, anisotropic", RoughConductor({}, brushed));
  run("roughconductor ggx, all normals", RoughConductor({}, all_normals));
  run("roughconductor beckmann", RoughConductor({}, beckmann));
  run("dielectric", Dielectric({}));
  run("roughdielectric ggx", RoughDielectric({}, ggx));
  run("roughdielectric beckmann", RoughDielectric({}, beckmann));
  run("thindielectric", ThinDielectric({}));
  run("plastic", Plastic({}));
  run("roughplastic ggx", RoughPlastic({}, ggx));
  run("roughplastic ggx, textured", plastic);
  run("roughplastic ggx, twosided", TwoSided(plastic, plastic));
  run("roughplastic beckmann", RoughPlastic({}, beckmann));
  run("principled", Principled({}));
  run("principled, all lobes", Principled(all_lobes));
  run("principledthin", PrincipledThin({}));
  run("mask of diffuse", Mask({0.5f}, diffuse));
  run("blend of diffuse and mirror", Blend({0.5f}, diffuse, mirror));
  run("bumpmap on diffuse", BumpMap({0, &texture}, 1, false, {}, diffuse));
  run("bumpmap on roughplastic", BumpMap({0, &texture}, 1, false, {}, plastic));
}
