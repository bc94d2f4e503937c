// A light that nobody else knows: all of it is in this file.
#include <doctest/doctest.h>

#include "evaluate/report/description_text.h"
#include "evaluate/report/vocabulary_text.h"
#include "lights/delta.h"
#include "math/frame.h"
#include "math/warp.h"
#include "mitsuba/plugins/emitter.h"
#include "pbrt/writer.h"
#include "scene/builder.h"
#include "scene/content_hash.h"
#include "support/foreign_plugin.h"
#include "support/transport_scene.h"

using namespace duet;
using namespace duet::test;

namespace {

/// A point whose intensity falls with the cosine of the angle from its axis, as that of a tiny
/// diffuse surface.
class GlowEmitter final : public PositionEmitter {
 public:
  GlowEmitter(const Transform& to_world, const Spectrum& intensity)
      : PositionEmitter(to_world(Point3f(0, 0, 0))),
        frame_(Normal3f(normalize(to_world(Vector3f(0, 0, 1))))),
        intensity_(intensity) {}

  std::optional<LightSample> sample_direct(const Point3f& from, const Point2f&) const override {
    const Vector3f away = from - position_;
    const float d2 = length_squared(away);
    if (!(d2 > 0)) return std::nullopt;
    LightSample s;
    s.wi = -away * (1 / std::sqrt(d2));
    const float cosine = dot(-s.wi, frame_.n);
    if (!(cosine > 0)) return std::nullopt;
    s.target = position_;
    s.weight = intensity_ * (cosine / d2);
    s.emission = cosine / kPi;
    s.delta = true;
    return s;
  }
  double power(double) const override { return double(kPi) * double(intensity_.luminance()); }
  std::optional<EmissionSample> sample_emission(const Point2f&,
                                                const Point2f& direction) const override {
    const Vector3f local = square_to_cosine_hemisphere(direction);
    if (!(local.z > 0)) return std::nullopt;
    return EmissionSample{{position_, frame_.to_world(local), INFINITY},
                          intensity_ * kPi,
                          local.z / kPi,
                          ShapePoint{}};
  }

 private:
  Frame frame_;
  Spectrum intensity_;
};

struct GlowLight {
  Spectrum intensity{1.0f};
  double dimming = 0;

  static constexpr auto fields() {
    using namespace parameter_words;
    return FieldList(
        field(&GlowLight::intensity, Parameter{"intensity", emission, kInitial, "along the axis"})
            .shown(": "),
        field(&GlowLight::dimming,
              Parameter{"dimming", number, kInitial, "share that is lost", fraction})
            .shown(", dimming ")
            .terse());
  }
  static constexpr const char* name() { return "glow"; }
  void count(SceneFeatures& f) const { ++f.point_lights; }
  LightPointer build(SceneBuilder&, const LightDescription& d) const {
    return std::make_unique<GlowEmitter>(Transform(d.to_world), intensity * float(1 - dimming));
  }
};

/// Has the fields of a glow: only its name tells the two apart.
struct GleamLight : GlowLight {
  static constexpr const char* name() { return "gleam"; }
};

const ForeignPlugin& glow_reader() {
  static const ForeignPlugin p(PluginKind::emitter, plugins::light<GlowLight>({.note = "made up"}));
  return p;
}

SceneDescription good_light(const std::string& version, const std::string& light) {
  return glow_reader().good(scene_text(version, light));
}

std::string lamp(const std::string& parameters) {
  return "<emitter type='glow'><transform name='to_world'><lookat origin='0,0,0' "
         "target='0,1,0' up='0,0,1'/></transform>" +
         parameters + "</emitter>";
}

const std::string kDimmedRed =
    "<rgb name='intensity' value='8 4 2'/><float name='dimming' value='0.5'/>";

}  // namespace

TEST_CASE("a foreign light is read by its fields, with their defaults, ranges and spellings") {
  CHECK(good_light("3.0.0", "<emitter type='glow'/>").lights.at(0).model ==
        decltype(LightDescription::model)(ForeignLight(GlowLight{})));
  const SceneDescription d = good_light("3.0.0", lamp(kDimmedRed));
  const auto& glow = std::get<ForeignLight>(d.lights.at(0).model).get<GlowLight>();
  CHECK(glow.intensity == Spectrum(8, 4, 2));
  CHECK(glow.dimming == 0.5);
  CHECK(good_light("0.6.0", lamp(kDimmedRed)) == d);
  CHECK(!(good_light("3.0.0", lamp("")) == d));
  CHECK(
      glow_reader()
          .read(scene_text("3.0.0", lamp("<float name='dimming' value='2'/>")))
          .has("the parameter \"dimming\" of <emitter type=\"glow\"> must be from 0 to 1, not 2"));
  CHECK(!read_scene("3.0.0", "<emitter type='glow'/>").scene);
}

TEST_CASE("a foreign light has what all lights have") {
  const SceneDescription d = good_light(
      "3.0.0", lamp("<float name='sampling_weight' value='3'/><medium type='homogeneous'/>"));
  CHECK(d.lights.at(0).sampling_weight == 3);
  CHECK(d.lights[0].medium.has_value());
  CHECK(d.lights[0].to_world.turned({0, 0, 1})[1] == doctest::Approx(1));
  glow_reader().round_trip(d);
}

TEST_CASE("a foreign light is listed, written, printed, counted and hashed") {
  const std::string table = compatibility_section(PluginKind::emitter, glow_reader().vocabulary());
  CHECK(table.find("| `glow` | 0.x, 3.x | done | made up |") != table.npos);
  CHECK(table.find("| `dimming` | float | `0` | 0.x, 3.x | done | share that is lost |") !=
        table.npos);
  const SceneDescription d = good_light("3.0.0", lamp(kDimmedRed));
  CHECK(DescriptionText(d).light(d.lights[0]) ==
        "glow at (0, 0, 0) towards (0, 1, 0): 8 4 2, dimming 0.5");
  CHECK(scene_features(d).point_lights == 1);
  CHECK(!is_environment(d.lights[0]));

  glow_reader().round_trip(d);
  CHECK(content_hash(good_light("3.0.0", lamp(""))) != content_hash(d));
  SceneDescription other = d;
  other.lights[0].model =
      ForeignLight(GleamLight{std::get<ForeignLight>(d.lights[0].model).get<GlowLight>()});
  CHECK(!(other == d));
  CHECK(content_hash(other) != content_hash(d));
  const auto lost = pbrt::write_pbrt(d).losses;
  CHECK(std::find(lost.begin(), lost.end(), "the light \"glow\" is missing") != lost.end());
}

TEST_CASE("a foreign light is rendered by all methods") {
  // Camera and light look along y from the middle of a ball, whose inside is seen in the light that
  // meets it across.
  ReadResult r = glow_reader().read(
      "<scene version='3.0.0'>" + lamp(kDimmedRed) + camera_xml("0,0,0", "0,1,0", 4) +
      "<shape type='sphere'><float name='radius' value='2'/><boolean name='flip_normals' "
      "value='true'/><bsdf type='diffuse'><rgb name='reflectance' value='0.5 0.5 0.5'/></bsdf>"
      "</shape></scene>");
  REQUIRE_MESSAGE(r.scene, r.messages());
  const TransportScene scene(std::move(r.scene->description));
  // The mean cosine of directions through the image, whose field of view is 50 degrees.
  const double tangent = std::tan(25 * double(kPi) / 180);
  double cosine = 0;
  constexpr int n = 64;
  for (int i = 0; i < n * n; ++i) {
    const double u = tangent * ((i % n + 0.5) * 2 / n - 1),
                 v = tangent * ((int(i / n) + 0.5) * 2 / n - 1);
    cosine += 1 / std::sqrt(1 + u * u + v * v) / (n * n);
  }
  constexpr double reflectance = 0.5, radius = 2;
  for (const char* method : {"path", "direct", "bdpt", "vcm", "ptracer"}) {
    CAPTURE(method);
    TransportScene::Parameters parameters;
    if (std::string(method) != "direct") parameters = {{"max_depth", "2"}};
    const Image image = scene.render(method, parameters, 1024, 1).image;
    for (int c = 0; c < 3; ++c) {
      const double intensity = 4.0 / (1 << c);
      double mean = 0;
      for (int i = 0; i < 16; ++i) mean += double(image.pixel(i % 4, i / 4)[c]) / 16;
      CHECK(mean ==
            doctest::Approx(reflectance / double(kPi) * intensity * cosine / (radius * radius))
                .epsilon(0.05));
    }
  }
}
