// Scenes that a program puts together are the same as those of files.
#include <doctest/doctest.h>

#include <cstring>

#include "app/workplace.h"
#include "duet/duet.h"
#include "library/contents.h"
#include "library/described_scene.h"

using namespace duet;
using namespace duet::test;

namespace {

constexpr const char* kEmptyScene = R"(<scene version="3.0.0">
  <integrator type="path"><integer name="max_depth" value="5"/></integrator>
  <sensor type="perspective" id="eye"><float name="fov" value="60"/>
    <transform name="to_world"><lookat origin="0.25,1,5" target="0,0,0" up="0,1,0"/></transform>
    <sampler type="independent"><integer name="sample_count" value="4"/></sampler>
    <film type="hdrfilm"><integer name="width" value="24"/><integer name="height" value="16"/>
      <string name="component_format" value="float32"/></film></sensor>
  <emitter type="constant"><rgb name="radiance" value="0.5 0.6 0.7"/></emitter>
)";

SceneObject chequered() {
  SceneObject texture("texture", "checkerboard");
  texture.set("color0", SceneRgb{0.9, 0.2, 0.1}).set("to_uv", SceneTransform::scale({3, 3, 1}));
  return SceneObject("bsdf", "diffuse").add(texture, "reflectance");
}

constexpr const char* kChequered = R"(<bsdf type="diffuse">
  <texture type="checkerboard" name="reflectance"><rgb name="color0" value="0.9 0.2 0.1"/>
    <transform name="to_uv"><scale value="3"/></transform></texture></bsdf>)";

std::vector<float> pixels_of(const SceneFile& scene) {
  const RenderedImage image = render_file(scene, {}).value();
  return {image.pixels().begin(), image.pixels().end()};
}

bool same_bits(const SceneFile& a, const SceneFile& b) {
  const std::vector<float> first = pixels_of(a), second = pixels_of(b);
  return first.size() == 24 * 16 * 4 && first.size() == second.size() &&
         std::memcmp(first.data(), second.data(), first.size() * sizeof(float)) == 0;
}

}  // namespace

TEST_SUITE("program") {
  TEST_CASE("a scene that is put together has the bits of the same text") {
    SceneObject scene = empty_scene();
    SceneObject plastic("bsdf", "roughplastic", "red & <$shiny>\n\t\"");
    plastic.set("diffuse_reflectance", SceneRgb{0.7, 0.1, 0.3}).set("alpha", 0.3f);
    plastic.set("nonlinear", true).set("distribution", "ggx");
    scene.add(ball()
                  .set("center", ScenePoint{0.5, 0.25, -1})
                  .set("radius", 1)
                  .add(SceneReference{plastic.id()}));
    const SceneTransform moved =
        SceneTransform::translate({-1, 0.5, 0.125}) * SceneTransform::rotate(40, {0, 1, 0});
    scene.add(SceneObject("shape", "rectangle").set("to_world", moved).add(chequered()));
    scene.add(plastic);
    SceneObject colour("spectrum", "irregular");
    colour.set("wavelengths", "400, 500, 700").set("values", "5, 10, 20");
    SceneObject lamp("emitter", "point");
    scene.add(lamp.set("position", ScenePoint{0, 3, 3}).add(colour, "intensity"));
    const SceneFile same = SceneFile::from_text(std::string(kEmptyScene) + R"(
      <shape type="sphere" id="ball"><point name="center" x="0.5" y="0.25" z="-1"/>
        <float name="radius" value="1"/><ref id="other"/></shape>
      <shape type="rectangle"><transform name="to_world"><rotate y="1" angle="40"/>
        <translate x="-1" y="0.5" z="0.125"/></transform>)" +
                                                kChequered + R"(</shape>
      <bsdf type="roughplastic" id="other"><rgb name="diffuse_reflectance" value="0.7 0.1 0.3"/>
        <float name="alpha" value="0.3"/><boolean name="nonlinear" value="true"/>
        <string name="distribution" value="ggx"/></bsdf>
      <emitter type="point"><point name="position" x="0" y="3" z="3"/>
        <spectrum type="irregular" name="intensity"><string name="wavelengths" value="400, 500, 700"/>
          <string name="values" value="5, 10, 20"/></spectrum></emitter></scene>)");
    const SceneFile put_together = SceneFile::from_description(scene);
    CHECK(put_together.name() == "<description>");
    CHECK(put_together.warnings().empty());
    CHECK(same_bits(put_together, same));
    CHECK(!same_bits(put_together, SceneFile::from_description(empty_scene())));
  }

  TEST_CASE("triangles in memory have the bits of those in files") {
    const Workplace place;
    const std::string rows[] = {"-1 -1 0 -0.5 -0.5 2 0 0\n", "1 -1 0.25 0.5 -0.5 1 1 0\n",
                                "1 1 0 0.5 0.5 1 1 1\n", "-1 1 0.125 -0.5 0.5 1 0 1\n",
                                "0 0 0.6 0 0 3 0.4 0.6\n"};
    std::string ply =
        "ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float y\n"
        "property float z\nproperty float nx\nproperty float ny\nproperty float nz\n"
        "property float u\nproperty float v\nelement face 4\n"
        "property list uchar int vertex_indices\nend_header\n";
    for (const std::string& row : rows) ply += row;
    place.write("square.ply", ply + "3 0 1 4\n3 1 2 4\n3 2 3 4\n3 3 0 4\n");
    place.write("square.obj",
                "v -1 -1 0\nv 1 -1 0.25\nv 1 1 0\nv -1 1 0.125\nv 0 0 0.6\n"
                "f 1 2 5\nf 2 3 5\nf 3 4 5\nf 4 1 5\n");
    const SceneFileOptions here{{}, {place.path("")}};
    const auto from_file = [&](const std::string& type, const std::string& content) {
      return SceneFile::from_text(std::string(kEmptyScene) + "<shape type=\"" + type +
                                      "\"><string name=\"filename\" value=\"square." + type +
                                      "\"/>" + content + "</shape></scene>",
                                  here);
    };
    const auto from_memory = [](SceneObject shape) {
      return SceneFile::from_description(with(shape));
    };
    const SceneObject full = SceneObject::mesh(bent_square_with_normals()).add(chequered());
    CHECK(same_bits(from_memory(full), from_file("ply", kChequered)));
    SceneObject flat = full;
    flat.set("face_normals", true);
    CHECK(same_bits(from_memory(flat),
                    from_file("ply", std::string(kChequered) +
                                         R"(<boolean name="face_normals" value="true"/>)")));
    CHECK(!same_bits(from_memory(flat), from_memory(full)));
    CHECK(same_bits(from_memory(SceneObject::mesh(bent_square())), from_file("obj", "")));
  }

  TEST_CASE("copies of triangles are one mesh, and other files stay files") {
    const Workplace place;
    place.write("square.ply",
                "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
                "property float z\nelement face 1\nproperty list uchar int vertex_indices\n"
                "end_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
    SceneObject square = SceneObject::mesh(bent_square());
    SceneObject scene = with(square).add(square).add(SceneObject::mesh(bent_square_with_normals()));
    scene.add(SceneObject("shape", "ply").set("filename", "square.ply"));
    const SceneFile read = SceneFile::from_description(scene, {{}, {place.path("")}});
    std::vector<const void*> meshes;
    std::vector<size_t> triangles;
    for (const ShapeDescription& shape : read.contents().loaded.description.shapes) {
      const auto& mesh = std::get<MeshShape>(shape.geometry).mesh;
      meshes.push_back(mesh.get());
      triangles.push_back(mesh->triangles.size());
    }
    CHECK(triangles == std::vector<size_t>{4, 4, 4, 1});
    CHECK(meshes[0] == meshes[1]);
    CHECK(meshes[0] != meshes[2]);
  }
}
