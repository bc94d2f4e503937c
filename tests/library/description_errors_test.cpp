// What scenes that a program puts together cannot have, and how messages name it.
#include <doctest/doctest.h>

#include <functional>
#include <limits>

#include "app/workplace.h"
#include "duet/duet.h"
#include "library/described_scene.h"

using namespace duet;
using namespace duet::test;

namespace {

constexpr float kNoNumber = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// The errors of a scene, "" if there are none.
std::string errors_of(const std::function<SceneObject()>& scene) {
  try {
    render_file(SceneFile::from_description(scene()), {});
  } catch (const SceneError& e) {
    return e.what();
  }
  return "";
}

/// A scene that is wrong, and the beginning of what is said of it.
struct Wrong {
  std::string text;
  std::function<SceneObject()> scene;
};

Wrong wrong_mesh(const std::string& text, const std::function<void(SceneMesh&)>& change) {
  return {"scene.square: error: " + text, [change] {
            SceneMesh mesh = bent_square_with_normals();
            change(mesh);
            return with(SceneObject::mesh(mesh, "square"));
          }};
}

}  // namespace

TEST_SUITE("program") {
  TEST_CASE("what scenes that are put together cannot have, by the objects that have it") {
    const std::vector<Wrong> all = {
        {"scene: error: the outermost object is of the kind \"scene\", not \"shape\"",
         [] { return ball(); }},
        {"scene.shap[0]: error: no object within a scene is of the kind \"shap\" (did you mean "
         "\"shape\"?)",
         [] {
           return with({"shap", "sphere"});
         }},
        {"scene.a>: error: no object within a scene is of the kind \"shape><x\"",
         [] {
           return with({"shape><x", "sphere", "a>"});
         }},
        {"scene.scene[0]: error: no object", [] { return with(empty_scene()); }},
        {"scene.ball: error: unknown shape type \"spere\"",
         [] {
           return with({"shape", "spere", "ball"});
         }},
        {"scene.shape[0]: error: <shape> needs the attribute \"type\"",
         [] {
           return with({"shape", ""});
         }},
        {"scene.ball: error: the id \"ball\" is given twice",
         [] { return with(ball()).add(ball()); }},
        {"scene.ball.radius: error: the parameter \"radius\" is given twice",
         [] { return with(ball().set("radius", 1).set("radius", 2)); }},
        {"scene.ball.to_world: error: the parameter \"to_world\" is given twice",
         [] {
           return with(ball().set("to_world", SceneTransform{}).set("to_world", SceneTransform{}));
         }},
        {"scene.ball.white: error: nothing has the id \"white\"",
         [] { return with(ball().add(SceneReference{"white"})); }},
        {"scene.ball.exterior: error: nothing has the id \"fog\"",
         [] { return with(ball().set("exterior", SceneReference{"fog"})); }},
        {"scene.ball.radius: error: \"nan\" is not a finite number",
         [] { return with(ball().set("radius", kNoNumber)); }},
        {"scene.ball.radius: error: \"1e+300\" is not a finite number",
         [] { return with(ball().set("radius", 1e300)); }},
        {"scene.ball.center: error: ",
         [] {
           return with(ball().set("center", ScenePoint{0, kInfinity, 0}));
         }},
        {"scene.ball.to_world: error: ",
         [] {
           return with(ball().set("to_world", SceneTransform::translate({kNoNumber, 0, 0})));
         }},
        {"scene.ball.radius: error: the parameter \"radius\" of <shape type=\"sphere\"> is of type",
         [] { return with(ball().set("radius", "big")); }},
        {"scene.ball.bsdf[0].reflectance: error: ",
         [] {
           return with(ball().add(
               SceneObject("bsdf", "diffuse").set("reflectance", SceneRgb{0, kNoNumber, 0})));
         }},
        {"scene.ball: error: <float> needs the attribute \"name\"",
         [] { return with(ball().set("", 0.5)); }},
        {"scene.a b: error: \"a b\" has a zero byte",
         [] { return with(ball(std::string("a\0b", 3)).set("radius", 1)); }},
        {"scene.shape[1].filename: error: file \"no.ply\" not found",
         [] { return with(ball()).add(SceneObject("shape", "ply").set("filename", "no.ply")); }},
        {"scene.square.filename: error: the parameter \"filename\" is given twice",
         [] {
           return with(SceneObject::mesh(bent_square(), "square").set("filename", "square.ply"));
         }},
        {"scene.lamp.emitter[0]: error: this light's shape has no area", [] {
           SceneMesh mesh = bent_square();
           mesh.triangles.clear();
           return with(SceneObject::mesh(mesh, "lamp").add(SceneObject("emitter", "area")));
         }}};
    for (const Wrong& wrong : all) {
      const std::string text = errors_of(wrong.scene);
      CHECK_MESSAGE(text.substr(0, wrong.text.size()) == wrong.text, text);
    }
  }

  TEST_CASE("triangles in memory that are wrong") {
    const std::vector<Wrong> all = {
        wrong_mesh("the mesh: triangle 2 uses vertex 5, but there are only 5 vertices",
                   [](SceneMesh& m) { m.triangles[2][1] = 5; }),
        wrong_mesh("the mesh: the index of a vertex cannot be -1",
                   [](SceneMesh& m) { m.triangles[1][0] = 0xffffffff; }),
        wrong_mesh("the mesh: the position of vertex 3 is not finite",
                   [](SceneMesh& m) { m.positions[3][1] = kNoNumber; }),
        wrong_mesh("the mesh: the position of vertex 0 is not finite",
                   [](SceneMesh& m) { m.positions[0][2] = kInfinity; }),
        wrong_mesh("the mesh: the texture coordinates of vertex 4 are not finite",
                   [](SceneMesh& m) { m.uvs[4][0] = kNoNumber; }),
        wrong_mesh("the mesh has 5 positions, but 4 normals",
                   [](SceneMesh& m) { m.normals.pop_back(); }),
        wrong_mesh("the mesh has 5 positions, but 6 texture coordinates",
                   [](SceneMesh& m) {
                     m.uvs.push_back({0, 0});
                   }),
        wrong_mesh("the mesh: triangle 0 uses vertex 0, but there are only 0 vertices",
                   [](SceneMesh& m) {
                     m = {{}, m.triangles};
                   })};
    for (const Wrong& wrong : all) {
      const std::string text = errors_of(wrong.scene);
      CHECK_MESSAGE(text.substr(0, wrong.text.size()) == wrong.text, text);
    }
    // The face's own normal counts where there is none of use, as in files.
    SceneMesh mesh = bent_square_with_normals();
    mesh.normals[0] = {kNoNumber, 0, 0}, mesh.normals[1] = {0, 0, 0};
    CHECK_NOTHROW(SceneFile::from_description(with(SceneObject::mesh(mesh))));
  }

  TEST_CASE("messages about scenes that are put together name objects, not lines") {
    const SceneObject scene = with(ball().set("radus", 1)).add(ball("").set("text", "$no\\$name"));
    const std::vector<std::string> warnings = SceneFile::from_description(scene).warnings();
    REQUIRE(warnings.size() == 2);
    CHECK(warnings[0] ==
          "scene.ball.radus: warning: unused parameter \"radus\" of <shape type=\"sphere\"> (did "
          "you mean \"radius\"?)");
    CHECK(contains(warnings[1], "scene.shape[1].text: warning: unused parameter"));
    try {
      SceneFile::from_description(with(ball().set("radius", "big")));
      FAIL("no error");
    } catch (const SceneError& e) {
      CHECK(e.first().file == "scene.ball.radius");
      CHECK(e.first().line == 0);
    }
  }

  TEST_CASE("scenes that are put together: trees without end, and arguments that make no sense") {
    SceneObject nested("bsdf", "twosided");
    for (int depth = 1; depth < 64; ++depth) nested = SceneObject("bsdf", "mask").add(nested);
    CHECK_THROWS_AS(SceneObject::scene().add(nested), std::invalid_argument);
    nested.set("a", 1);
    SceneObject itself = ball();
    itself.add(itself);
    CHECK(itself.entries().size() == 1);
    CHECK_THROWS_AS(SceneTransform::look_at({1, 2, 3}, {1, 2, 3}, {0, 1, 0}),
                    std::invalid_argument);
    CHECK_THROWS_AS(SceneTransform::look_at({0, 0, 0}, {0, 2, 0}, {0, 1, 0}),
                    std::invalid_argument);
    const SceneFileOptions cut{{}, {std::string("a\0b", 3)}};
    CHECK_THROWS_AS(SceneFile::from_description(empty_scene(), cut), std::invalid_argument);
  }
}
