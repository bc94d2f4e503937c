// Coats over diffuse bases and metals: against walks of light that are written here, against the
// closed form where there is one, and against figures of pbrt-v4.
#include "materials/layered_material.h"

#include <random>

#include "materials/dielectric.h"
#include "math/sampler.h"
#include "support/bsdf_checks.h"
#include "support/statistics.h"

using namespace duet;
using namespace duet::test;

namespace {

class Numbers {
 public:
  explicit Numbers(uint32_t seed) : engine_(seed) {}
  float operator()() { return std::min(float(engine_() >> 8) * 0x1p-24f, kBelowOne); }
  Point2f square() {
    const float x = (*this)();
    return {x, (*this)()};
  }

 private:
  std::mt19937 engine_;
};

/// Light that leaves the surface again: its direction and weight, and whether mirrors alone made
/// it.
struct Left {
  Vector3f direction;
  Spectrum weight;
  bool mirrored;
};

/// Follows light as the model describes it, without any of the model's code: one event after the
/// other, until it is out or absorbed or has had too many.
std::optional<Left> follow(const LayeredModel& m, Vector3f w, Numbers& next) {
  const RoughDielectricModel rough{m.coat, m.eta, Spectrum(1), Spectrum(1)};
  const DielectricModel smooth{m.eta, Spectrum(1), Spectrum(1)};
  const auto coat = [&](const Vector3f& o) {
    const Point2f v = next.square();
    return m.smooth_coat ? smooth.sample(o, next(), v, Transport::importance)
                         : rough.sample(o, next(), v, Transport::importance);
  };
  Left light{{}, Spectrum(1), m.smooth_coat};
  auto s = coat(w);
  if (!s) return std::nullopt;
  light.weight = s->weight;
  w = s->wi;
  float depth = 0;
  for (int event = 0; w.z < 0 || depth > 0; ++event) {
    // After so many events there is nothing left but to get out.
    const bool last = event == m.max_depth;
    if (m.scatters()) {
      const float way = -std::log(1 - next()) * std::abs(w.z);
      const float there = w.z < 0 ? depth + way : depth - way;
      if (there > 0 && there < m.thickness) {
        if (last) return std::nullopt;
        // Henyey and Greenstein's deflection.
        const float g = m.g, x = next();
        const float cosine = std::abs(g) < 1e-4f
                                 ? 2 * x - 1
                                 : (1 + g * g - sqr((1 - g * g) / (1 - g + 2 * g * x))) / (2 * g);
        const float sine = safe_sqrt(1 - cosine * cosine), phi = 2 * kPi * next();
        w = Frame(Normal3f(w)).to_world({sine * std::cos(phi), sine * std::sin(phi), cosine});
        light.weight *= m.albedo;
        light.mirrored = false;
        depth = there;
        continue;
      }
    } else {
      light.weight *= std::exp(-m.thickness / std::abs(w.z));
    }
    if (w.z < 0) {
      if (last) return std::nullopt;
      depth = m.thickness;
      const Point2f v = next.square();
      if (!m.is_metal) {
        w = square_to_cosine_hemisphere(v);
        light.weight *= m.base;
        light.mirrored = false;
      } else {
        const Vector3f o = -w;
        const Vector3f h = m.smooth_base ? Vector3f(0, 0, 1) : m.metal.sample(o, v);
        w = reflect(o, h);
        if (!(w.z > 0)) return std::nullopt;
        light.weight *= fresnel_conductor(dot(o, h), m.base, m.base_k);
        if (!m.smooth_base) {
          light.weight *= m.metal.shadowing(o, w);
          light.mirrored = false;
        }
      }
    } else {
      depth = 0;
      s = coat(-w);
      if (!s) return std::nullopt;
      light.weight *= s->weight;
      w = s->wi;
      if (w.z > 0) break;
      if (last) return std::nullopt;
    }
  }
  light.direction = w;
  return light;
}

struct LayerCase {
  const char* name;
  const char* bsdf;
};

const LayerCase kWalks[] = {
    {"smooth coat, diffuse, scattering",
     R"({"type": "coateddiffuse", "thickness": 0.5, "albedo": [0.9, 0.5, 0.2], "g": 0.4})"},
    {"rough coat, diffuse, scattering",
     R"({"type": "coateddiffuse", "alpha": 0.3, "thickness": 0.8, "albedo": 0.8, "g": -0.5,
         "eta": 1.8})"},
    {"anisotropic coat, diffuse",
     R"({"type": "coateddiffuse", "alpha_u": 0.6, "alpha_v": 0.15, "reflectance": 0.8})"},
    {"smooth coat, rough metal",
     R"({"type": "coatedconductor", "conductor_alpha": 0.25, "conductor_eta": [0.2, 0.9, 1.3],
         "conductor_k": [3.9, 2.5, 2.3]})"},
    {"rough coat, smooth metal",
     R"({"type": "coatedconductor", "alpha": 0.4, "reflectance": 0.9, "thickness": 0.1})"},
    {"rough coat, rough metal",
     R"({"type": "coatedconductor", "alpha": 0.2, "conductor_alpha": 0.4, "reflectance": 0.7})"},
    {"rough coat, smooth metal, scattering",
     R"({"type": "coatedconductor", "alpha": 0.4, "albedo": 0.7, "thickness": 0.3})"},
    {"smooth coat, smooth metal, scattering",
     R"({"type": "coatedconductor", "albedo": [0.9, 0.6, 0.3], "thickness": 0.6, "g": 0.3,
         "reflectance": 0.9})"},
    {"smooth coat, rough metal, few events",
     R"({"type": "coatedconductor", "conductor_alpha": 0.5, "reflectance": 0.95, "albedo": 0.9,
         "thickness": 0.5, "max_depth": 3})"},
    {"thin air between glass", R"({"type": "coateddiffuse", "alpha": 0.3, "eta": 0.8,
         "thickness": 0.2, "albedo": 0.5})"},
};

const Vector3f kWalkViews[] = {{0.1f, 0, 0.99f}, {0.6f, 0.3f, 0.7f}, {0.9f, -0.2f, 0.3f}};

LayeredModel walk_model(const TestMaterial& material) {
  const Surface surface = flat_surface();
  if (const auto* d = dynamic_cast<const CoatedDiffuse*>(&*material)) return d->walk_model(surface);
  return dynamic_cast<const CoatedConductor&>(*material).model(surface);
}

/// Parts of the hemisphere: three heights, forwards or backwards.
size_t part_of(const Vector3f& w) {
  return (w.z < 0.5f ? 0u : w.z < 0.85f ? 1u : 2u) + (w.x < 0 ? 3u : 0u);
}

void hold_equal(Failures& failures, const char* what, const Moments& a, const Moments& b) {
  const double error = std::hypot(a.error(), b.error());
  if (std::abs(a.mean() - b.mean()) > 4.5 * error + 1e-4)
    failures.add(fmt::format("{}: {} ± {}, followed {} ± {}", what, a.mean(), a.error(), b.mean(),
                             b.error()));
}

/// Directional reflectance by samples of the surface at any of its points.
double reflectance(const Material& material, const Vector3f& wo) {
  Surface surface = flat_surface();
  Moments sum;
  Sampler sampler(SampleSequence::sobol, 5, 0, 0);
  for (uint32_t i = 0; i < 32768; ++i) {
    sampler.start_sample(i);
    surface.position = {float(i), 0, 0};
    const Bsdf bsdf = material.bind(surface, wo);
    const Point2f v = sampler.next_2d();
    const auto s = bsdf.sample(sampler.next_1d(), v, Transport::radiance);
    sum.add(s ? double(s->weight.g) : 0.0);
  }
  return sum.mean();
}

}  // namespace

TEST_SUITE("layers") {
  TEST_CASE("where light goes is where it goes if it is followed") {
    for (const LayerCase& c : kWalks) {
      const TestMaterial material(c.bsdf);
      LayeredModel m = walk_model(material);
      Failures failures(c.name);
      for (const Vector3f& view : kWalkViews) {
        const Vector3f wo = normalize(view);
        Numbers next(7);
        // In each part of the hemisphere, and off mirrors.
        std::vector<Moments> sampled(7), followed(7);
        for (uint32_t i = 0; i < 60000; ++i) {
          m.seed = i;
          const float u = next();
          const auto s = m.sample(wo, u, next.square(), Transport::radiance);
          const auto f = follow(m, wo, next);
          for (size_t part = 0; part < 7; ++part) {
            const bool in_s = s && (s->delta ? 6 : part_of(s->wi)) == part;
            const bool in_f = f && (f->mirrored ? 6 : part_of(f->direction)) == part;
            sampled[part].add(in_s ? double(s->weight[int(i % 3)]) : 0.0);
            followed[part].add(in_f ? double(f->weight[int(i % 3)]) : 0.0);
          }
        }
        for (size_t part = 0; part < 7; ++part)
          hold_equal(failures, fmt::format("from {}, part {}", text(wo), part).c_str(),
                     sampled[part], followed[part]);
      }
    }
  }

  TEST_CASE("the closed form is the mean of the walks") {
    for (const float alpha : {0.0f, 0.1f, 0.5f, 1.0f})
      for (const float thickness : {0.0f, 0.01f, 0.7f})
        for (const int max_depth : {1, 2, 3, 10}) {
          const float eta = max_depth == 3 ? 1.8f : 1.5f;
          CoatLayerOptions options;
          options.alpha_u.constant = options.alpha_v.constant = alpha;
          options.thickness.constant = thickness;
          options.max_depth = max_depth;
          options.eta = eta;
          const CoatedDiffuse material({Spectrum(0.9f, 0.5f, 0.1f)}, options);
          const CoatedDiffuseModel closed = material.closed_model(flat_surface());
          LayeredModel walk = material.walk_model(flat_surface());
          Failures failures(fmt::format("alpha {}, thickness {}, at most {} events", alpha,
                                        thickness, max_depth));
          for (const Vector3f& o : kWalkViews)
            for (const Vector3f& i : kWalkViews) {
              const Vector3f wo = normalize(o), wi = normalize(Vector3f(-i.x, i.y, i.z));
              Moments sums[3];
              for (walk.seed = 0; walk.seed < 3000; ++walk.seed) {
                const Spectrum value = walk.eval(wo, wi, Transport::radiance).value;
                for (int k = 0; k < 3; ++k) sums[k].add(double(value[k]));
              }
              const Spectrum exact = closed.eval(wo, wi, Transport::radiance).value;
              // Tables are off by 1e-3 of the light.
              for (int k = 0; k < 3; ++k)
                if (std::abs(sums[k].mean() - double(exact[k])) >
                    4.5 * sums[k].error() + 2e-3 * double(exact[k]))
                  failures.add(fmt::format("{} to {}: {} ± {}, closed {}", text(wo), text(wi),
                                           sums[k].mean(), sums[k].error(), exact[k]));
            }
        }
  }

  TEST_CASE("tables for any roughness agree with those for one") {
    const CoatTransmittance any(1.5f, 0.05f);
    for (const float alpha : {0.02f, 0.13f, 0.41f, 0.8f}) {
      const CoatTransmittance one(1.5f, 0.05f, alpha);
      const auto a = any(alpha), b = one(alpha);
      CHECK(a.shares.returned == doctest::Approx(b.shares.returned).epsilon(0.01));
      CHECK(a.shares.received == doctest::Approx(b.shares.received).epsilon(0.004));
      for (const float cosine : {0.05f, 0.3f, 0.7f, 1.0f})
        CHECK(a.row(cosine) == doctest::Approx(b.row(cosine)).epsilon(0.01));
    }
  }

  TEST_CASE("a surface under a coat shows what pbrt-v4 shows of it") {
    // In even light, seen nearly along the normal.
    const Vector3f wo = normalize(Vector3f(0.05f, 0, 1));
    const auto kept = [&](const char* bsdf) { return reflectance(*TestMaterial(bsdf), wo); };
    CHECK(kept(R"({"type": "coateddiffuse", "reflectance": 1, "max_depth": 100})") ==
          doctest::Approx(0.917).epsilon(0.002));
    CHECK(kept(R"({"type": "coateddiffuse", "reflectance": 0.9})") ==
          doctest::Approx(0.713).epsilon(0.002));
    CHECK(kept(R"({"type": "coateddiffuse", "reflectance": 0.5})") ==
          doctest::Approx(0.304).epsilon(0.003));
  }

  TEST_CASE("without absorption and limit a white base under a smooth coat keeps all light") {
    for (const float z : {1.0f, 0.5f, 0.1f}) {
      const Vector3f wo(std::sqrt(1 - z * z), 0, z);
      CHECK(reflectance(*TestMaterial(R"({"type": "coateddiffuse", "reflectance": 1,
                "thickness": 0, "max_depth": 1000})"),
                        wo) == doctest::Approx(1).epsilon(1e-3));
      CHECK(reflectance(*TestMaterial(R"({"type": "coateddiffuse", "reflectance": 1, "albedo": 1,
                "thickness": 0.5, "max_depth": 1000})"),
                        wo) == doctest::Approx(1).epsilon(0.02));
      CHECK(reflectance(*TestMaterial(R"({"type": "coatedconductor", "thickness": 0,
                "max_depth": 1000})"),
                        wo) == doctest::Approx(1).epsilon(1e-3));
    }
  }

  TEST_CASE("an estimate is the same whenever and from wherever it is asked for") {
    for (const LayerCase& c : kWalks) {
      const TestMaterial material(c.bsdf);
      LayeredModel m = walk_model(material);
      const Vector3f a = normalize(kWalkViews[0]), b = normalize(kWalkViews[1]);
      const Spectrum there = m.eval(a, b, Transport::radiance).value / b.z;
      CAPTURE(c.name);
      CHECK(m.eval(a, b, Transport::radiance).value / b.z == there);
      CHECK(close(m.eval(b, a, Transport::importance).value / a.z, there, 1e-5));
      // At other points of the surface it is another one.
      ++m.seed;
      CHECK(m.eval(a, b, Transport::radiance).value / b.z != there);
      Surface surface = flat_surface();
      const auto seed_at = [&](float x) {
        surface.position = {x, 0, 0};
        const Bsdf bsdf = material->bind(surface, a);
        return bsdf.component(0).model.layered.seed;
      };
      CHECK(seed_at(1) == seed_at(1));
      CHECK(seed_at(1) != seed_at(1.0000001f));
    }
  }

  TEST_CASE("coats that are textured are smooth only where their roughness is small") {
    class Ramp final : public Texture {
     public:
      Spectrum color(const Surface& s) const override { return Spectrum(value(s)); }
      float value(const Surface& s) const override { return s.uv.x; }
      Point2f gradient(const Surface&) const override { return {1, 0}; }
      Spectrum average() const override { return Spectrum(0.5f); }
    };
    const Ramp ramp;
    CoatLayerOptions options;
    options.alpha_u = options.alpha_v = {0, &ramp};
    const CoatedDiffuse material({Spectrum(0.5f)}, options);
    Surface surface = flat_surface();
    for (const float alpha : {0.0f, 0.3f}) {
      surface.uv = {alpha, 0};
      CHECK(material.bind(surface, {0, 0, 1}).has_delta() == (alpha == 0));
      CoatLayerOptions constant;
      constant.alpha_u.constant = constant.alpha_v.constant = alpha;
      const CoatedDiffuse same({Spectrum(0.5f)}, constant);
      const Vector3f wo = normalize(kWalkViews[1]), wi = normalize(kWalkViews[2]);
      CHECK(material.bind(surface, wo).eval(wi, Transport::radiance).value.g ==
            doctest::Approx(same.bind(surface, wo).eval(wi, Transport::radiance).value.g)
                .epsilon(0.005));
    }
  }
}
