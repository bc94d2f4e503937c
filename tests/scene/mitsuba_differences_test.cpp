// Which scenes meet what Mitsuba is known to render wrongly.
#include "scene/mitsuba_differences.h"

#include <doctest/doctest.h>

#include <set>

#include "integrators/make_integrator.h"
#include "support/memory_scene.h"

using namespace duet;
using namespace duet::test;

namespace {

SceneDescription read(const std::string& content, const std::string& version = "3.0.0") {
  const ReadResult r = read_text("<scene version='" + version + "'><sensor type='perspective'/>" +
                                 content + "</scene>");
  INFO(r.messages());
  REQUIRE(r.scene);
  return r.description();
}

/// The names of what a scene meets, each followed by a space.
std::string names(const SceneDescription& scene) {
  std::string out;
  for (const MitsubaDifference* d : mitsuba_differences(scene, scene_features(scene)))
    out += std::string(d->id) + " ";
  return out;
}

std::string met(const std::string& content, const std::string& version = "3.0.0") {
  return names(read(content, version));
}

const std::string kPath = "<integrator type='path'/>";

std::string ball_at(const std::string& inside, double radius = 1, double x = 0) {
  return kPath + fmt::format(
                     "<shape type='sphere'><float name='radius' value='{}'/><point "
                     "name='center' x='{}' y='0' z='0'/>{}</shape>",
                     radius, x, inside);
}

std::string blend(const std::string& a, const std::string& b, double weight = 0.5) {
  return fmt::format(
      "<bsdf type='blendbsdf'><float name='weight' value='{}'/><bsdf type='{}'/><bsdf "
      "type='{}'/></bsdf>",
      weight, a, b);
}

std::string medium(double extinction, const std::string& phase = "") {
  return fmt::format(
      "<medium name='interior' type='homogeneous'><float name='sigma_t' value='{}'/>{}</medium>",
      extinction, phase);
}

}  // namespace

TEST_CASE("differences from Mitsuba have names and texts of their own") {
  std::set<std::string_view> ids;
  for (const MitsubaDifference& d : mitsuba_differences()) {
    CAPTURE(d.id);
    CHECK(ids.insert(d.id).second);
    for (const std::string_view text : {d.construct, d.mitsuba, d.measured, d.reason}) {
      CHECK(!text.empty());
      CHECK(mitsuba_differences_markdown().find(text) != std::string::npos);
    }
  }
  CHECK(ids.size() >= 9);
}

TEST_CASE("blends are met if one side has a delta lobe and the other does not") {
  CHECK(met(ball_at(blend("diffuse", "conductor"))) == "blend-delta ");
  CHECK(met(ball_at(blend("plastic", "roughconductor"))) == "blend-delta ");
  CHECK(met(ball_at("<bsdf type='twosided'>" + blend("conductor", "diffuse") + "</bsdf>")) ==
        "blend-delta ");
  CHECK(met(ball_at(blend("diffuse", "roughplastic"))).empty());
  CHECK(met(ball_at(blend("conductor", "dielectric"))).empty());
  CHECK(met(ball_at(blend("diffuse", "null"))) == "null-paths ");
  CHECK(met(ball_at(blend("diffuse", "conductor", 1))).empty());
  // What no shape has is not rendered.
  CHECK(met(blend("diffuse", "conductor") + ball_at("")).empty());
}

TEST_CASE("bumps are met over anisotropic BSDFs") {
  const auto bumpy = [](const std::string& nested) {
    return met(ball_at("<bsdf type='bumpmap'><texture type='checkerboard'/>" + nested + "</bsdf>"));
  };
  const std::string brushed =
      "<bsdf type='roughconductor'><float name='alpha_u' value='0.1'/><float name='alpha_v' "
      "value='0.3'/></bsdf>";
  CHECK(bumpy(brushed) == "bump-tangents ");
  CHECK(bumpy("<bsdf type='twosided'>" + brushed + "</bsdf>") == "bump-tangents ");
  CHECK(bumpy("<bsdf type='principled'><float name='anisotropic' value='0.5'/></bsdf>") ==
        "bump-tangents ");
  for (const std::string map : {"bumpmap", "normalmap"})
    CHECK(bumpy("<bsdf type='twosided'><bsdf type='" + map +
                "'><texture name='normalmap' type='checkerboard'/><bsdf type='diffuse'/></bsdf>"
                "</bsdf>") == "bump-tangents ");
  CHECK(bumpy("<bsdf type='roughconductor'/>").empty());
  CHECK(bumpy("<bsdf type='principled'/>").empty());
  CHECK(met(ball_at(brushed)).empty());
}

TEST_CASE("null lobes are met by path tracing without an environment that is seen") {
  const std::string masked =
      "<bsdf type='mask'><float name='opacity' value='0.5'/><bsdf type='diffuse'/></bsdf>";
  const auto with = [](const std::string& method, const std::string& bsdf,
                       const std::string& light = "") {
    return met("<integrator type='" + method + "/integrator>" + light + "<shape type='sphere'>" +
               bsdf + "</shape>");
  };
  const std::string sky = "<emitter type='constant'/>",
                    hidden = "path'><boolean name='hide_emitters' value='true'/><";
  CHECK(with("path'><", masked) == "null-paths ");
  CHECK(with("path'><", "<bsdf type='thindielectric'/>") == "null-paths ");
  CHECK(with("path'><", "<bsdf type='diffuse'/>").empty());
  CHECK(with("path'><", masked, sky).empty());
  CHECK(with(hidden, masked, sky) == "null-paths ");
  CHECK(with("volpath'><", masked).empty());
}

TEST_CASE("light from infinitely far away is met behind a medium without end") {
  const auto within = [](const std::string& medium, const std::string& more) {
    return "<medium type='homogeneous' id='fog'>" + medium +
           "</medium><sensor type='perspective'><ref id='fog'/></sensor>" + more;
  };
  const auto warned = [](const std::string& content) {
    const SceneDescription scene = read(content);
    Diagnostics diagnostics;
    check_support(scene, scene.integrator, diagnostics);
    CHECK(!diagnostics.has_errors());
    return !diagnostics.all().empty();
  };
  const std::string thick = "<float name='sigma_t' value='0.1'/>",
                    clear = "<float name='sigma_t' value='0'/>",
                    inside = "<shape type='sphere'><ref name='interior' id='fog'/></shape>";
  for (const std::string light : {"constant", "directional", "sunsky"}) {
    const std::string sky = "<emitter type='" + light + "'/>";
    CHECK(met(within(thick, sky)) == "endless-media ");
    CHECK(warned(within(thick, sky)));
    for (const std::string& content :
         {within(clear, sky), within(thick, sky + inside), within(thick, "")}) {
      CHECK(met(content).empty());
      CHECK(!warned(content));
    }
  }
}

TEST_CASE("lamps are met that are meshes with other normals than their triangles") {
  const auto lamp = [](const std::string& light, const Vector3f& normal) {
    SceneDescription scene = read(kPath + "<shape type='cube'>" + light + "</shape>");
    auto mesh = std::make_shared<TriangleMesh>(make_rectangle());
    mesh->normals.assign(mesh->positions.size(), Normal3f(normal));
    MeshShape shape;
    shape.mesh = mesh;
    scene.shapes.at(0).geometry = shape;
    return names(scene);
  };
  const std::string light = "<emitter type='area'/>";
  CHECK(lamp(light, {0.6f, 0, 0.8f}) == "smooth-light-samples ");
  CHECK(lamp(light, {0, 0, 1}).empty());
  CHECK(lamp("", {0.6f, 0, 0.8f}).empty());
}

TEST_CASE("lamps are met that are cylinders without round cross-sections") {
  const auto lamp = [](const std::string& scale, const std::string& light) {
    return met("<shape type='cylinder'>" + light + "<transform name='to_world'><scale " + scale +
               "/><rotate x='1' angle='40'/></transform></shape>");
  };
  const std::string light = "<emitter type='area'/>";
  CHECK(lamp("x='0.6' y='0.9' z='1'", light) == "elliptic-cylinders ");
  CHECK(lamp("x='0.6' y='0.6' z='1'", light).empty());
  CHECK(lamp("x='0.6' y='-0.6' z='1'", light).empty());
  CHECK(lamp("x='0.6' y='0.9' z='1'", "").empty());
}

TEST_CASE("lamps are met whose triangles share a part of a texture") {
  const auto lamp = [](const std::string& shape, const std::string& radiance) {
    return met("<shape type='" + shape + "'><emitter type='area'>" + radiance +
               "</emitter></shape>");
  };
  const std::string board = "<texture type='checkerboard' name='radiance'/>",
                    white = "<rgb name='radiance' value='1'/>";
  CHECK(lamp("cube", board) == "texture-light-samples ");
  CHECK(lamp("cube", white).empty());
  CHECK(lamp("rectangle", board).empty());
  CHECK(lamp("sphere", board).empty());
}

TEST_CASE("lamps are met whose colours are attributes of a mesh") {
  const auto lamp = [](const std::string& radiance) {
    return met("<shape type='cube'><emitter type='area'>" + radiance + "</emitter></shape>");
  };
  CHECK(lamp("<texture type='mesh_attribute' name='radiance'><string name='name' "
             "value='vertex_color'/></texture>") ==
        "attribute-light-samples texture-light-samples ");
  CHECK(lamp("<rgb name='radiance' value='1'/>").empty());
}

TEST_CASE("direct light is met with several samples of lights that no ray hits") {
  const auto direct = [](int samples, const std::string& light) {
    return met(
        fmt::format("<integrator type='direct'><integer name='emitter_samples' "
                    "value='{}'/></integrator><emitter type='{}'/>",
                    samples, light));
  };
  for (const char* light : {"point", "spot", "directional"})
    CHECK(direct(2, light) == "direct-delta-lights ");
  CHECK(direct(1, "point").empty());
  CHECK(direct(2, "constant").empty());
}

TEST_CASE("ray offsets are met in dense media and in small scenes") {
  // The offset is 0.00009 · (1 + 1) here.
  CHECK(met(ball_at(medium(100))).empty());
  CHECK(met(ball_at(medium(120))) == "ray-offset-media ");
  CHECK(met(ball_at("", 0.01)).empty());
  CHECK(met(ball_at("", 0.004)) == "ray-offset-surfaces ");
  CHECK(met(ball_at("", 1, 100)).empty());
  CHECK(met(ball_at("", 1, 250)) == "ray-offset-surfaces ");
}

TEST_CASE("flakes are met unless they are balls") {
  SceneDescription scene = read(ball_at(medium(1,
                                               "<phase type='blendphase'><float name='weight' "
                                               "value='0.5'/><phase type='hg'/><phase "
                                               "type='rayleigh'/></phase>")));
  const auto flakes = [&](const SggxPhase& phase) {
    for (PhaseDescription& p : scene.phases)
      if (std::holds_alternative<RayleighPhase>(p.model) ||
          std::holds_alternative<SggxPhase>(p.model))
        p.model = phase;
    return names(scene);
  };
  using Matrix = std::array<double, 6>;
  CHECK(flakes({Matrix{2, 2, 2, 0, 0, 0}}).empty());
  CHECK(flakes({Matrix{2, 2, 1, 0, 0, 0}}) == "sggx-flakes ");
  CHECK(flakes({Matrix{2, 2, 2, 0, 0.5, 0}}) == "sggx-flakes ");
  auto grid = std::make_shared<VolumeGrid>();
  grid->size = {2, 1, 1};
  grid->channels = 6;
  grid->values = {1, 1, 1, 0, 0, 0, 3, 3, 3, 0, 0, 0};
  scene.volumes.emplace_back().grid = grid;
  const SggxPhase varying{VolumeId(scene.volumes.size() - 1)};
  CHECK(flakes(varying).empty());
  grid->values[6] = 2;
  CHECK(flakes(varying) == "sggx-flakes ");
}

TEST_CASE("motion is met if it stretches across the axes") {
  const auto moving = [](const std::string& transform) {
    return met(kPath +
                   "<shape type='sphere'><animation name='toWorld'><transform time='0'/>"
                   "<transform time='1'>" +
                   transform + "</transform></animation></shape>",
               "0.6.0");
  };
  CHECK(moving("<scale x='2'/><rotate z='1' angle='30'/>").empty());
  CHECK(moving("<rotate z='1' angle='30'/><scale x='2'/>") == "animation-shear ");
}
