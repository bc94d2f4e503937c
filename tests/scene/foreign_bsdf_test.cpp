// A BSDF that nobody else knows: all of it is in this file.
#include <doctest/doctest.h>

#include "evaluate/report/description_text.h"
#include "evaluate/report/vocabulary_text.h"
#include "materials/materials.h"
#include "math/warp.h"
#include "mitsuba/plugins/bsdf.h"
#include "mitsuba/writer.h"
#include "scene/builder.h"
#include "scene/content_hash.h"
#include "scene/texture_uses.h"
#include "support/foreign_plugin.h"
#include "support/transport_scene.h"

using namespace duet;
using namespace duet::test;

namespace {

/// Reflects evenly in all directions.
struct ChalkModel {
  Spectrum reflectance;

  ModelEval eval(const Vector3f& wo, const Vector3f& wi, Transport) const {
    if (!(wo.z > 0 && wi.z > 0)) return {};
    return {reflectance * (wi.z / kPi), wi.z / kPi};
  }
  std::optional<ModelSample> sample(const Vector3f& wo, float, const Point2f& v,
                                    Transport transport) const {
    const Vector3f wi = square_to_cosine_hemisphere(v);
    return sample_from(eval(wo, wi, transport), wi);
  }
  bool has_smooth() const { return true; }
  bool has_delta() const { return false; }
  bool needs_choice() const { return false; }
};

class Chalk final : public SingleModelMaterial<Chalk> {
 public:
  Chalk(const ColorSlot& color, float dust) : color_(color), dust_(dust) {}
  ForeignModel model(const Surface& s) const {
    return ForeignModel(ChalkModel{color_(s) * (1 - dust_)});
  }
  SurfaceNeeds needs() const override { return {.uv = color_.needs_uv()}; }
  bool transmits() const override { return false; }

 private:
  ColorSlot color_;
  float dust_;
};

struct ChalkMaterial {
  ColorInput color = Spectrum(0.75f);
  double dust = 0;

  static constexpr auto fields() {
    using namespace parameter_words;
    return FieldList(
        field(&ChalkMaterial::color, Parameter{"chalk_color", reflectance, kInitial}).shown(" "),
        field(&ChalkMaterial::dust,
              Parameter{"dust", number, kInitial, "share that is absorbed", fraction})
            .shown(", dust ")
            .terse());
  }
  static constexpr const char* name() { return "chalk"; }
  Scattering scattering() const { return {.diffuse = true}; }
  MaterialPointer build(SceneBuilder& b, const SourceLocation&) const {
    return std::make_unique<Chalk>(b.slot(color), float(dust));
  }
};

const ForeignPlugin& chalk_reader() {
  static const ForeignPlugin p(PluginKind::bsdf, plugins::bsdf<ChalkMaterial>({.note = "made up"}));
  return p;
}

/// A scene with a ball of it.
std::string ball(const std::string& version, const std::string& bsdf) {
  return scene_text(version, "<emitter type='constant'/><shape type='sphere'>" + bsdf + "</shape>");
}

ReadResult read_chalk(const std::string& version, const std::string& bsdf) {
  return chalk_reader().read(ball(version, bsdf));
}

SceneDescription good_bsdf(const std::string& version, const std::string& bsdf) {
  return chalk_reader().good(ball(version, bsdf));
}

const std::string kDusty =
    "<bsdf type='chalk'><rgb name='chalk_color' value='0.5 0.25 0.125'/>"
    "<float name='dust' value='0.5'/></bsdf>";

}  // namespace

TEST_CASE("a foreign BSDF is read by its fields, with their defaults, ranges and spellings") {
  CHECK(good_bsdf("3.0.0", "<bsdf type='chalk'/>").materials.at(0).model ==
        MaterialModel(ChalkMaterial{}));
  const SceneDescription d = good_bsdf("3.0.0", kDusty);
  const auto& chalk = d.materials.at(0).model.get<ChalkMaterial>();
  CHECK(chalk.color == ColorInput(Spectrum(0.5f, 0.25f, 0.125f)));
  CHECK(chalk.dust == 0.5);
  CHECK(good_bsdf("0.6.0",
                  "<bsdf type='chalk'><rgb name='chalkColor' value='0.5 0.25 0.125'/>"
                  "<float name='dust' value='0.5'/></bsdf>") == d);
  CHECK(read_chalk("3.0.0", "<bsdf type='chalk'><float name='dust' value='2'/></bsdf>")
            .has("the parameter \"dust\" of <bsdf type=\"chalk\"> must be from 0 to 1, not 2"));
  CHECK(read_chalk("3.0.0", "<bsdf type='chalk'><float name='dost' value='0.5'/></bsdf>")
            .has("did you mean \"dust\"?"));
  CHECK(read_chalk("3.0.0", "<bsdf type='chlk'/>").has("did you mean \"chalk\"?"));
  // Others do not know it.
  CHECK(!Vocabulary::built_in().find(PluginKind::bsdf, "chalk"));
  CHECK(!read_scene("3.0.0", "<bsdf type='chalk'/>").scene);
}

TEST_CASE("a foreign BSDF is listed, written, printed and counted") {
  const std::string table = compatibility_section(PluginKind::bsdf, chalk_reader().vocabulary());
  CHECK(table.find("| `chalk` | 0.x, 3.x | done | made up |") != table.npos);
  CHECK(table.find("| `dust` | float | `0` | 0.x, 3.x | done | share that is absorbed |") !=
        table.npos);
  const SceneDescription d = good_bsdf("3.0.0", kDusty);
  CHECK(DescriptionText(d).material(MaterialId{0}) == "chalk 0.5 0.25 0.125, dust 0.5");
  CHECK(scene_features(d).diffuse == 1);
  CHECK(!transmits(d, MaterialId{0}));

  const std::string xml = chalk_reader().round_trip(d);
  CHECK(xml.find("<bsdf type=\"chalk\"") != xml.npos);
  CHECK(xml.find("name=\"dust\" value=\"0.5\"") != xml.npos);
  // A terse field is written only where it says something.
  const MitsubaXml clean = write_mitsuba_xml(good_bsdf("3.0.0", "<bsdf type='chalk'/>"));
  CHECK(clean.text.find("chalk_color") != clean.text.npos);
  CHECK(clean.text.find("dust") == clean.text.npos);
  CHECK(content_hash(good_bsdf("3.0.0", "<bsdf type='chalk'/>")) != content_hash(d));
}

TEST_CASE("the textures of a foreign BSDF are found, and it can be nested in others") {
  const SceneDescription d = good_bsdf(
      "3.0.0",
      "<bsdf type='mask'><bsdf type='chalk'><texture type='checkerboard' name='chalk_color'/>"
      "</bsdf></bsdf>");
  CHECK(DescriptionText(d).material(MaterialId{1}) ==
        "mask, opacity 0.5 [chalk texture #0, dust 0]");
  REQUIRE(texture_uses(d).size() == 1);
  CHECK(texture_uses(d)[0].as_color);
  CHECK(!texture_uses(d)[0].as_number);
}

TEST_CASE("a foreign BSDF is rendered by all methods") {
  // Every point of a ball sees nothing but the sky: it shows its reflectance.
  ReadResult r = chalk_reader().read(
      "<scene version='3.0.0'><emitter type='constant'/>" + camera_xml("0,-0.1,3", "0,0,0", 4) +
      "<shape type='sphere'><float name='radius' value='2'/>" + kDusty + "</shape></scene>");
  REQUIRE_MESSAGE(r.scene, r.messages());
  const TransportScene scene(std::move(r.scene->description));
  for (const char* method : {"path", "direct", "bdpt", "vcm"}) {
    CAPTURE(method);
    const Image image = scene.render(method, {}, 64, 1).image;
    for (int i = 0; i < 3; ++i)
      CHECK(double(image.pixel(1, 2)[i]) == doctest::Approx(0.25 / (1 << i)).epsilon(0.05));
  }
}
