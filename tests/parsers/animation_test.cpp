// <animation> and the shutter: what moves, when, and what cannot.
#include <doctest/doctest.h>

#include "mitsuba/writer.h"
#include "parsers/plugin_checks.h"
#include "scene/features.h"

using namespace duet;
using namespace duet::test;

namespace {

const std::string kAnimation =
    "<animation name='toWorld'>\n"
    "<transform time='2'><translate x='4'/></transform>\n"
    "<transform time='1'><translate x='2'/></transform>\n"
    "</animation>";

/// The messages of a scene of 0.6 with a thing that has this content.
std::string messages(const std::string& begin, const std::string& content, const std::string& end) {
  return read_scene("0.6.0", begin + content + end, image()).messages();
}
std::string in_sphere(const std::string& content) {
  return messages("<shape type='sphere'>\n", content, "\n</shape>");
}
std::string in_sphere_animation(const std::string& content) {
  return in_sphere("<animation name='toWorld'>\n" + content + "\n</animation>");
}
bool has(const std::string& text, const std::string& part) {
  CAPTURE(text);
  const bool found = text.find(part) != text.npos;
  CHECK(found);
  return found;
}

/// Of a thing that moves by kAnimation after it has been placed at y = 1.
template <class Thing>
void check_moves(const Thing& thing, double y = 0) {
  REQUIRE(thing.motion.keyframes().size() == 2);
  CHECK(thing.motion.keyframes()[0] == Keyframe{1, Matrix4::translate(2, 0, 0)});
  CHECK(thing.motion.keyframes()[1] == Keyframe{2, Matrix4::translate(4, 0, 0)});
  CHECK(thing.to_world[1][3] == y);
  CHECK(thing.to_world[0][3] == 0);
}

}  // namespace

TEST_CASE("shapes, instances, lights and sensors move") {
  check_moves(good("0.6.0", "<shape type='sphere'><point name='center' x='0' y='1' z='0'/>" +
                                kAnimation + "</shape>")
                  .shapes.at(0),
              1);
  for (const char* type : {"rectangle", "cube", "disk", "cylinder"})
    check_moves(good("0.6.0", std::string("<shape type='") + type + "'>" + kAnimation + "</shape>")
                    .shapes.at(0));
  check_moves(good("0.6.0", "<shape type='obj'><string name='filename' value='a.obj'/>" +
                                kAnimation + "</shape>")
                  .shapes.at(0));
  check_moves(good("0.6.0",
                   "<shape type='shapegroup' id='g'><shape type='cube'/></shape>"
                   "<shape type='instance'><ref id='g'/>" +
                       kAnimation + "</shape>")
                  .shapes.at(0));
  for (const char* type : {"point", "spot", "directional", "projector", "collimated", "envmap"})
    check_moves(
        good("0.6.0",
             std::string("<emitter type='") + type + "'>" +
                 (std::string(type) == "envmap" ? "<string name='filename' value='b.exr'/>" : "") +
                 kAnimation + "</emitter>")
            .lights.at(0));
  for (const char* type : {"perspective", "thinlens", "orthographic", "telecentric", "spherical",
                           "perspective_rdist", "radiancemeter", "fluencemeter"})
    check_moves(sensor(
        "0.6.0", type,
        kAnimation +
            (std::string(type) == "thinlens" ? "<float name='apertureRadius' value='1'/>" : "")));
}

TEST_CASE("a scene at a time stands still") {
  SceneDescription d =
      good("0.6.0", "<shape type='sphere'><point name='center' x='0' y='1' z='0'/>" + kAnimation +
                        "</shape><emitter type='point'>" + kAnimation +
                        "</emitter><shape type='cube'/>");
  CHECK(count_moving(d) == 2);
  CHECK(describe(scene_features(d)).ends_with("; 2 moving things"));
  const SceneDescription at = scene_at(d, 1.5);
  CHECK(count_moving(at) == 0);
  CHECK(at.shapes[0].to_world == Matrix4::translate(3, 1, 0));
  CHECK(at.lights[0].to_world == Matrix4::translate(3, 0, 0));
  CHECK(at.shapes[1] == d.shapes[1]);
  // Features are those at the opening of the shutter.
  d.sensors[0].shutter = {1.5, 2};
  CHECK(scene_features(d).bounds.upper.x == doctest::Approx(4));
}

TEST_CASE("an animation that is one place is a transform") {
  const SceneDescription d =
      good("0.6.0",
           "<shape type='cube'><animation name='toWorld'><transform time='3'><translate "
           "x='2'/></transform><transform time='4'><translate x='2'/></transform>"
           "</animation></shape>");
  CHECK(count_moving(d) == 0);
  CHECK(d.shapes[0].to_world == Matrix4::translate(2, 0, 0));
}

TEST_CASE("the shutter") {
  CHECK(sensor("0.6.0", "perspective").shutter == std::array<double, 2>{0, 0});
  CHECK(sensor("0.6.0", "perspective",
               "<float name='shutterOpen' value='-1'/><float name='shutterClose' value='2'/>")
            .shutter == std::array<double, 2>{-1, 2});
  CHECK(sensor("3.0.0", "perspective", "<float name='shutter_close' value='2'/>").shutter ==
        std::array<double, 2>{0, 2});
  const ReadResult r = read_text(
      "<scene version='0.6.0'><integrator type='path'/><sensor type='perspective'>\n"
      "<float name='shutterOpen' value='2'/>\n<float name='shutterClose' "
      "value='1'/></sensor></scene>");
  has(r.messages(), "scene.xml:3:28: error: the shutter closes at 1, before it opens at 2");
}

TEST_CASE("broken animations") {
  has(in_sphere_animation(""), "scene.xml:3:1: error: <animation> needs a <transform> with a time");
  has(in_sphere_animation("<transform/>"),
      "scene.xml:4:1: error: <transform> needs the attribute \"time\"");
  has(in_sphere_animation("<transform time='soon'/>"),
      "scene.xml:4:12: error: \"soon\" is not a finite number");
  has(in_sphere_animation("<transform time='inf'/>"), "\"inf\" is not a finite number");
  has(in_sphere_animation(
          "<transform time='1'/>\n<transform time='1.0'><scale x='2'/></transform>"),
      "scene.xml:5:1: error: the <animation> has two transforms for the time 1");
  has(in_sphere_animation("<transform time='0'><scale x='0'/></transform>"),
      "scene.xml:4:21: error: a scale of zero cannot be inverted");
  has(in_sphere_animation("<transform time='0'/>\n<transform time='1'><scale x='-1'/></transform>"),
      "scene.xml:5:1: error: between the times 0 and 1 the <animation> turns space inside out");
  has(in_sphere_animation("<translate x='1'/>"),
      "scene.xml:4:1: error: <translate> cannot stand in an <animation>, only <transform>");
  has(in_sphere("<transform name='toWorld' time='1'/>"), "\"time\"");
  has(in_sphere("<animation><transform time='0'/></animation>"), "needs the attribute \"name\"");
  has(read_scene("3.0.0", "<shape type='sphere'>\n" + kAnimation + "</shape>").messages(),
      "scene.xml:3:1: error: <animation> only exists in Mitsuba 0.x, where things move");
}

TEST_CASE("what does not move says so") {
  const std::string fixed = "cannot be an animation: what moves are shapes, their instances";
  has(messages("<emitter type='sky'>\n", kAnimation, "</emitter>"),
      "scene.xml:3:1: error: the parameter \"toWorld\" of <emitter type=\"sky\"> " + fixed);
  has(messages("<texture type='bitmap'><string name='filename' value='a.png'/>", kAnimation,
               "</texture>"),
      "toWorld");
  has(messages("<shape type='shapegroup' id='g'>\n<shape type='cube'>", kAnimation,
               "</shape></shape>"),
      "scene.xml:3:1: error: a shape in a shape group cannot move; its instances can");
  has(read_text("<scene version='0.6.0'><integrator type='path'/><sensor type='perspective'>"
                "<animation name='toWorld'><transform time='0'/><transform time='1'><scale "
                "value='2'/></transform></animation></sensor></scene>")
          .messages(),
      "the transform of <sensor type=\"perspective\"> must not scale");
}

TEST_CASE("plugins of motion that are refused give a true reason") {
  has(messages("<shape type='animatedinstance'>", "", "</shape>"),
      "its tracks are a binary file of 0.4 or earlier: use an instance with an animation");
  has(messages("<shape type='deformable'>", "", "</shape>"),
      "shapes move, but keep their form: use a mesh");
  has(read_text("<scene version='0.6.0'><integrator type='motion'/></scene>").messages(),
      "ways of points between two frames are no light");
}

TEST_CASE("Mitsuba 3 cannot write motion: a scene stands as it does when the shutter opens") {
  SceneDescription d = good("0.6.0", "<shape type='cube'>" + kAnimation + "</shape>");
  d.sensors[0].shutter = {1.5, 2};
  const MitsubaXml xml = write_mitsuba_xml(d);
  REQUIRE(xml.losses.size() == 1);
  CHECK(xml.losses[0] == "motion is missing: everything stands as it does at the time 1.5");
  const ReadResult r = read_text(xml.text);
  REQUIRE_MESSAGE(r.scene, r.messages());
  CHECK(r.description() == scene_at(d, 1.5));
}
