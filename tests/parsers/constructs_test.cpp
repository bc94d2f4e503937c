// Ways to write scenes that Mitsuba accepts: each means what a plain spelling does (the list for
// people is docs/constructs.md).
#include <doctest/doctest.h>

#include "parsers/plugin_checks.h"

using namespace duet;
using namespace duet::test;

namespace {

/// One way to write something, the same plainly, and what is said about it ("" if nothing is).
struct Construct {
  std::string name, text, plain;
  std::string warning = {};
};

/// A light, without which there are warnings in files of 0.x.
std::string light(const std::string& version) {
  return version.starts_with('0') ? "<emitter type='point'/>" : "";
}

std::string scene(const std::string& version, const std::string& content) {
  return "<scene version='" + version + "'>" + content + light(version) + "</scene>";
}

/// The same with a camera and an integrator.
std::string whole_scene(const std::string& version, const std::string& content) {
  return scene_text(version, content + light(version));
}

/// A scene with a camera of this film.
std::string with_film(const std::string& version, const std::string& content) {
  return scene(version,
               "<integrator type='path'/><sensor type='perspective'><film type='hdrfilm'>" +
                   content + "</film></sensor>");
}

std::string utf16(const std::string& text, bool little_endian, bool mark) {
  std::string out = !mark ? "" : little_endian ? "\xff\xfe" : "\xfe\xff";
  for (const char c : text) out += little_endian ? std::string{c, '\0'} : std::string{'\0', c};
  return out;
}

const std::string kPath = "<integrator type='path'/>";
const std::string kCamera = "<sensor type='perspective'/>";
const std::string kFilm =
    "<film type='hdrfilm' ID><integer name='width' value='5'/>"
    "<integer name='height' value='7'/></film>";

std::string film(const std::string& id) {
  std::string text = kFilm;
  return text.replace(text.find("ID"), 2, id);
}

std::vector<Construct> parts_of_the_sensor() {
  const std::string sampler = "<integer name='sample_count' value='9'/></sampler>";
  const auto sensor = [](const std::string& content) {
    return "<sensor type='perspective'>" + content + "</sensor>";
  };
  return {
      {"a film as a child of the scene",
       scene("3.0.0", kPath + film("id='f'") + sensor("<ref id='f'/>")),
       scene("3.0.0", kPath + sensor(film("")))},
      {"a sampler as a child of the scene",
       scene("3.0.0",
             kPath + "<sampler type='independent' id='s'>" + sampler + sensor("<ref id='s'/>")),
       scene("3.0.0", kPath + sensor("<sampler type='independent'>" + sampler))},
      {"a reconstruction filter as a child of the scene",
       scene("3.0.0", kPath + "<rfilter type='tent' id='r'/>" +
                          sensor("<film type='hdrfilm'><ref id='r'/></film>")),
       scene("3.0.0", kPath + sensor("<film type='hdrfilm'><rfilter type='tent'/></film>"))},
      {"films, samplers and filters that no sensor uses",
       scene("3.0.0", kPath + kCamera + film("") + "<sampler type='independent'/>" +
                          "<rfilter type='box'/>"),
       scene("3.0.0", kPath + kCamera)},
      {"<mode> of a fork", scene("2.0.0", "<mode type='scalar_rgb'/>" + kPath + kCamera),
       scene("2.0.0", kPath + kCamera), "<mode> is no element of Mitsuba"},
  };
}

std::vector<Construct> parts_of_the_film() {
  const std::string rgb = "<string name='pixelFormat' value='rgb'/>";
  return {
      {"an image of spectra", with_film("0.6.0", "<string name='pixelFormat' value='spectrum'/>"),
       with_film("0.6.0", rgb)},
      {"an image of spectra with alpha",
       with_film("0.6.0", "<string name='pixelFormat' value='spectrumAlpha'/>"),
       with_film("0.6.0", "<string name='pixelFormat' value='rgba'/>")},
      {"an image of whole numbers",
       with_film("3.0.0", "<string name='component_format' value='uint32'/>"),
       with_film("3.0.0", "<string name='component_format' value='float32'/>"),
       "the image is written as float32"},
      {"a label that tells about the integrator",
       with_film("0.6.0",
                 "<string name='label[10, 10]' value=\"by $integrator['type'], "
                 "$film['width'] wide\"/>"),
       with_film("0.6.0", ""), "annotations have no effect"},
      {"metadata that tell about the scene",
       with_film("0.6.0", "<string name=\"metadata['used']\" value=\"$scene['memUsage']\"/>"),
       with_film("0.6.0", ""), "annotations have no effect"},
  };
}

std::vector<Construct> encodings() {
  const std::string latin = "<?xml version='1.0' encoding='ISO-8859-1'?>" +
                            scene("3.0.0", kPath + kCamera + "<shape type='sphere' id='caf\xe9'/>");
  const std::string plain = scene("3.0.0", kPath + kCamera);
  return {
      {"UTF-16, little-endian", utf16(plain, true, true), plain},
      {"UTF-16, big-endian", utf16(plain, false, true), plain},
      {"UTF-16 without a mark", utf16(plain, true, false), plain},
      {"big-endian UTF-16 without a mark", utf16(plain, false, false), plain},
      {"ISO-8859-1", latin,
       scene("3.0.0", kPath + kCamera + "<shape type='sphere' id='caf\xc3\xa9'/>")},
      {"zero bytes at the end", plain + std::string("\n\0\0", 3), plain},
      {"a schema",
       "<scene version='0.5.0' xmlns:xsi='http://www.w3.org/2001/XMLSchema-instance' "
       "xsi:noNamespaceSchemaLocation='scene.xsd'>" +
           kPath + kCamera + light("0.5.0") + "</scene>",
       scene("0.5.0", kPath + kCamera)},
  };
}

std::vector<Construct> entities() {
  const std::string plain = whole_scene("0.5.0",
                                        "<shape type='sphere'><float name='radius' value='2'/>"
                                        "</shape>");
  const auto with = [](const std::string& declarations, const std::string& content) {
    return "<?xml version='1.0'?>\n<!DOCTYPE scene [" + declarations + "]>\n" +
           whole_scene("0.5.0", content);
  };
  return {
      {"an entity in an attribute",
       with("<!-- \" --><!ENTITY r \"2\">",
            "<shape type='sphere'><float name='radius' value='&r;'/></shape>"),
       plain},
      {"an entity with elements, and another in it",
       with("<!ENTITY r '2'><!ENTITY ball '<shape type=\"sphere\"><float name=\"radius\" "
            "value=\"&r;\"/></shape>'>",
            "&ball;"),
       plain},
      {"an entity in another file",
       with("<!ENTITY ball SYSTEM \"ball.xml\">", "<!-- &ball; -->&ball;"), plain},
  };
}

std::vector<Construct> values() {
  const auto ball = [](const std::string& version, const std::string& content) {
    return whole_scene(version, "<shape type='sphere'>" + content + "</shape>");
  };
  const auto metal = [&](const std::string& content) {
    return ball("3.0.0", "<bsdf type='conductor'>" + content + "</bsdf>");
  };
  const auto grey = [&](const std::string& attributes) {
    return ball("3.0.0",
                "<bsdf type='diffuse'><spectrum name='reflectance' " + attributes + "/></bsdf>");
  };
  const auto tiles = [&](const std::string& scale) {
    return ball("3.0.0",
                "<bsdf type='diffuse'><texture type='checkerboard' name='reflectance'>"
                "<transform name='to_uv'><scale " +
                    scale + "/></transform></texture></bsdf>");
  };
  return {
      {"an empty file name of a spectrum", grey("value='0.3' filename=''"), grey("value='0.3'")},
      {"an empty value of a spectrum", grey("value='' filename='s.spd'"), grey("filename='s.spd'")},
      {"measurements that come with Mitsuba",
       metal("<spectrum name='eta' filename='data/ior/Au.eta.spd'/>"
             "<spectrum name='k' filename='data/ior/Au.k.spd'/>"),
       metal("<string name='material' value='Au'/>")},
      {"srgb_d65 of Mitsuba 2",
       ball("2.0.0",
            "<emitter type='area'><spectrum type='srgb_d65' name='radiance'>"
            "<rgb name='color' value='3 2 1'/></spectrum></emitter>"),
       ball("2.0.0", "<emitter type='area'><rgb name='radiance' value='3 2 1'/></emitter>")},
      {"texture coordinates scaled by 0 in z", tiles("x='2' y='3' z='0'"), tiles("x='2' y='3'")},
      {"a last row of a matrix that is not 0 0 0 1",
       ball("3.0.0",
            "<transform name='to_world'><matrix value='2 0 0 1 0 2 0 0 0 0 2 0 0 0 0 2'/>"
            "</transform>"),
       ball("3.0.0",
            "<transform name='to_world'><matrix value='2 0 0 1 0 2 0 0 0 0 2 0 0 0 0 1'/>"
            "</transform>"),
       "the last row 0 0 0 2 of the matrix has no effect in Mitsuba 3"},
      {"a negative radius", ball("3.0.0", "<float name='radius' value='-2'/>"),
       ball("3.0.0", "<transform name='to_world'><scale value='-2'/></transform>")},
      {"a sphere with a centre and a scale",
       ball("0.6.0",
            "<point name='center' x='2' y='0' z='0'/><transform name='to_world'><scale value='3'/>"
            "<translate y='1'/></transform>"),
       ball("0.6.0",
            "<float name='radius' value='3'/><transform name='to_world'><translate x='2' y='1'/>"
            "</transform>")},
      {"a parameter given twice, of which the last counts",
       ball("0.6.0", "<float name='radius' value='2'/><float name='radius' value='3'/>"),
       ball("0.6.0", "<float name='radius' value='3'/>"),
       "the parameter \"radius\" is given again"},
      {"two BSDFs, of which the last counts",
       ball("0.6.0", "<bsdf type='dielectric'/><bsdf type='plastic'/>"),
       ball("0.6.0", "<bsdf type='plastic'/>"), "<shape type=\"sphere\"> has several BSDFs"},
      {"a medium that is neither inside nor outside",
       ball("3.0.0", "<medium type='homogeneous' name='around'/>"),
       "<scene version='3.0.0'>" + kPath + kCamera +
           "<medium type='homogeneous'/><shape type='sphere'/></scene>",
       "the medium has no effect"},
      {"a spotlight whose beam is wider than its cone",
       whole_scene("3.0.0",
                   "<emitter type='spot'><float name='cutoff_angle' value='20'/>"
                   "<float name='beam_width' value='30'/></emitter>"),
       whole_scene("3.0.0",
                   "<emitter type='spot'><float name='cutoff_angle' value='20'/>"
                   "<float name='beam_width' value='20'/></emitter>")},
  };
}

void check_all(const std::vector<Construct>& constructs) {
  MemoryFiles files;
  files.texts = {{"/scene/s.spd", "400 0.1\n700 0.2\n"},
                 {"/scene/ball.xml",
                  "<?xml version='1.0' encoding='utf-8'?>\n<shape type='sphere'>"
                  "<float name='radius' value='2'/></shape>"}};
  for (const Construct& c : constructs) {
    CAPTURE(c.name);
    const ReadResult read = read_text(c.text, files), plain = read_text(c.plain, files);
    REQUIRE_MESSAGE(plain.scene, plain.messages());
    INFO(read.messages());
    CHECK(plain.messages() == "");
    CHECK(read.scene.has_value());
    if (!read.scene) continue;
    CHECK(read.description() == plain.description());
    if (c.warning.empty())
      CHECK(read.messages() == "");
    else
      CHECK(read.has("warning: " + c.warning));
  }
}

}  // namespace

TEST_CASE("what belongs to a sensor may stand elsewhere") {
  check_all(parts_of_the_sensor());
}

TEST_CASE("films of Mitsuba 0.x and 3 say things that change no image") {
  check_all(parts_of_the_film());
}

TEST_CASE("scene files come in several encodings") {
  check_all(encodings());
}

TEST_CASE("files of 0.x may declare entities") {
  check_all(entities());
}

TEST_CASE("values are taken as Mitsuba takes them") {
  check_all(values());
}
