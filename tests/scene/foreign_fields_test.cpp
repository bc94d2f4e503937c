// A BSDF that nobody else knows, of whose fields is said whatever a record can say.
#include <doctest/doctest.h>

#include "evaluate/report/description_text.h"
#include "evaluate/report/vocabulary_text.h"
#include "materials/wrappers.h"
#include "mitsuba/plugins/bsdf.h"
#include "mitsuba/writer.h"
#include "scene/builder.h"
#include "scene/content_hash.h"
#include "support/foreign_plugin.h"
#include "support/transport_scene.h"

using namespace duet;
using namespace duet::test;

namespace {

enum class Finish { matte, satin, gloss };
constexpr std::string_view kFinishes[] = {"matte", "satin", "gloss"};

/// Two sides, each with a BSDF of its own, under a varnish that nobody sees.
struct VarnishMaterial {
  MaterialId front{}, back{};
  Finish finish = Finish::matte;
  double sheen = 0.25;
  double age = 0;
  int batch = 7;
  int coats = 1;
  std::optional<double> gap;

  static constexpr auto fields() {
    using namespace parameter_words;
    using M = VarnishMaterial;
    return FieldList(
        field(&M::front).shown("front "),
        field(&M::back).shown("back ").optional().when(
            [](const M& m) { return m.back != m.front; }),
        field(&M::finish, Parameter{"finish", string, kInitial, "matte, satin or gloss"})
            .words(kFinishes)
            .shown_if_changed(", finish "),
        field(&M::sheen, Parameter{"sheen", number, kInitial, "of satin", fraction})
            .when([](const M& m) { return m.finish == Finish::satin; })
            .shown(", sheen "),
        field(&M::age, Parameter{"age", number, kInitial, "in years"}).unwritten().shown(", age "),
        field(&M::batch, Parameter{"batch", integer, kInitial, "on the can"}).not_compared(),
        field(&M::coats, Parameter{"coats", integer, kInitial, "", positive})
            .read_by_plugin()
            .terse(),
        field(&M::gap, Parameter{"gap", number, ""}).shown(", gap "));
  }
  static constexpr const char* name() { return "varnish"; }
  Scattering scattering() const { return {}; }
  MaterialPointer build(SceneBuilder& b, const SourceLocation&) const {
    const Material *on_front = b.material(front), *on_back = b.material(back);
    if (!on_front || !on_back) return nullptr;
    return std::make_unique<TwoSided>(*on_front, *on_back);
  }
};

/// Adds the coats, so that it shows if somebody else has read them, too.
bool check_varnish(SceneReader&, Properties& p, VarnishMaterial& m) {
  m.coats += p.integer("coats") - 1;
  if (m.finish == Finish::satin || !p.has("sheen")) return true;
  p.error("sheen", "only satin has a sheen");
  return false;
}

const ForeignPlugin& reader() {
  static const ForeignPlugin p(PluginKind::bsdf, plugins::bsdf<VarnishMaterial, check_varnish>());
  return p;
}

/// Holds one BSDF, and what is said besides.
std::string ball(const std::string& content) {
  return scene_text("3.0.0",
                    "<emitter type='constant'/><shape type='sphere'><bsdf type='varnish'>"
                    "<bsdf type='diffuse'/>" +
                        content + "</bsdf></shape>");
}

const std::string kSatin = "<string name='finish' value='satin'/>";
const std::string kOther = "<bsdf type='diffuse'><rgb name='reflectance' value='1 0 0'/></bsdf>";

SceneDescription good(const std::string& content) {
  return reader().good(ball(content));
}

const VarnishMaterial& varnish(const SceneDescription& d) {
  return d.materials.back().model.get<VarnishMaterial>();
}

std::string text(const SceneDescription& d) {
  return DescriptionText(d).material(MaterialId{uint32_t(d.materials.size() - 1)});
}

}  // namespace

TEST_CASE("a foreign record has words, and numbers that may be missing or are its reader's") {
  const SceneDescription d =
      good(kSatin +
           "<float name='sheen' value='0.5'/><float name='age' value='3'/><integer name='batch' "
           "value='8'/><integer name='coats' value='3'/><float name='gap' value='0.125'/>");
  const VarnishMaterial& v = varnish(d);
  CHECK(v.finish == Finish::satin);
  CHECK(v.sheen == 0.5);
  CHECK(v.age == 3);
  CHECK(v.batch == 8);
  CHECK(v.coats == 3);
  CHECK(v.gap == 0.125);
  CHECK(!varnish(good("")).gap);
  CHECK(reader()
            .read(ball("<string name='finish' value='sating'/>"))
            .has("cannot be \"sating\" (did you mean \"satin\"?); it is one of matte, satin, "
                 "gloss"));
  const ReadResult checked = reader().read(ball("<float name='sheen' value='0.5'/>"));
  CHECK(checked.has("only satin has a sheen"));
  const std::string table = compatibility_section(PluginKind::bsdf, reader().vocabulary());
  CHECK(table.find("| `finish` | string | `matte` | 0.x, 3.x | done | matte, satin or gloss |") !=
        table.npos);
  CHECK(table.find("| `batch` | integer | `7` |") != table.npos);
}

TEST_CASE("the BSDFs in a foreign one are its fields in their order, one of which may be missing") {
  const VarnishMaterial one = varnish(good(""));
  CHECK(one.back == one.front);
  const SceneDescription two = good(kOther);
  CHECK(varnish(two).front == MaterialId{0});
  CHECK(varnish(two).back == MaterialId{1});
  CHECK(two.materials.back().model.nested() == std::vector{MaterialId{0}, MaterialId{1}});
  CHECK(reader().read(ball(kOther + kOther)).has("needs 1 or 2 nested BSDFs, not 3"));
  CHECK(reader()
            .read(scene_text("3.0.0", "<shape type='sphere'><bsdf type='varnish'/></shape>"))
            .has("needs 1 or 2 nested BSDFs, not 0"));
  const std::string xml = reader().round_trip(two);
  CHECK(xml.find("<bsdf type=\"varnish\"") != xml.npos);
  reader().round_trip(good(""));
}

TEST_CASE("a foreign record says which of its values are shown, written and compared") {
  const SceneDescription plain = good(""), satin = good(kSatin);
  CHECK(text(plain) == "varnish, age 0 [diffuse 0.5]");
  CHECK(text(satin) == "varnish, finish satin, sheen 0.25, age 0 [diffuse 0.5]");
  CHECK(text(good("<float name='gap' value='2'/>")) == "varnish, age 0, gap 2 [diffuse 0.5]");

  const std::string written = reader().round_trip(satin);
  CHECK(written.find("name=\"finish\" value=\"satin\"") != written.npos);
  CHECK(written.find("name=\"sheen\" value=\"0.25\"") != written.npos);
  CHECK(written.find("\"age\"") == written.npos);
  CHECK(written.find("\"coats\"") == written.npos);
  CHECK(written.find("\"gap\"") == written.npos);
  CHECK(reader().round_trip(plain).find("sheen") == std::string::npos);
  reader().round_trip(good("<integer name='coats' value='3'/><float name='gap' value='2'/>"));

  // Each value counts by itself.
  for (const char* other :
       {"<float name='age' value='3'/>", "<integer name='coats' value='3'/>",
        "<float name='gap' value='2'/>", "<string name='finish' value='gloss'/>"}) {
    INFO(other);
    CHECK(!(good(other) == plain));
    CHECK(content_hash(good(other)) != content_hash(plain));
  }
  const SceneDescription batch = good("<integer name='batch' value='8'/>");
  CHECK(batch == plain);
  CHECK(content_hash(batch) == content_hash(plain));
}

TEST_CASE("a foreign BSDF that holds others is rendered by all methods") {
  ReadResult r = reader().read(
      "<scene version='3.0.0'><emitter type='constant'/>" + camera_xml("0,-0.1,3", "0,0,0", 4) +
      "<shape type='sphere'><float name='radius' value='2'/><bsdf type='varnish'>" + kOther +
      "</bsdf></shape></scene>");
  REQUIRE_MESSAGE(r.scene, r.messages());
  const TransportScene scene(std::move(r.scene->description));
  for (const char* method : {"path", "bdpt"}) {
    CAPTURE(method);
    const Image image = scene.render(method, {}, 64, 1).image;
    CHECK(double(image.pixel(1, 2)[0]) == doctest::Approx(1).epsilon(0.05));
    CHECK(image.pixel(1, 2)[1] == 0);
  }
}
