// Which materials the parts of OBJ files get.
#include <doctest/doctest.h>

#include "mitsuba/writer.h"
#include "support/memory_scene.h"

using namespace duet;
using namespace duet::test;

namespace {

const std::string kVertices = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
/// Two parts, in turns.
const std::string kTwoMaterials =
    kVertices +
    "mtllib materials/x.mtl\nusemtl Red\nf 1 2 3\nusemtl Blue\nf 1 3 4\n"
    "g more\nusemtl Red\nf 1 2 4\n";
const std::string kLibrary =
    "newmtl Red\nKd 1 0 0\nnewmtl Blue\nKd 0 0 0.5\nnewmtl Unused\nmap_Kd missing.png\n";

MemoryFiles material_files() {
  MemoryFiles f;
  f.texts = {{"/scene/meshes/two.obj", kTwoMaterials}, {"/scene/meshes/materials/x.mtl", kLibrary}};
  return f;
}

std::string shape(const std::string& content = "") {
  return "<shape type='obj' id='thing'><string name='filename' value='meshes/two.obj'/>" + content +
         "</shape>";
}

ReadResult read(const std::string& content, const MemoryFiles& f = material_files(),
                const char* version = "0.6.0") {
  return read_scene(version, shape(content) + "<emitter type='constant'/>", f);
}

const MaterialDescription& material_of(const ReadResult& r, size_t i) {
  return r.description().materials.at(size_t(r.description().shapes.at(i).material));
}
template <class M>
M model(const ReadResult& r, size_t i) {
  INFO(r.messages());
  REQUIRE(r.scene);
  return material_of(r, i).model.get<M>();
}
ColorInput reflectance(const ReadResult& r, size_t i) {
  return model<DiffuseMaterial>(r, i).reflectance;
}
size_t triangles(const ReadResult& r, size_t i) {
  return std::get<MeshShape>(r.description().shapes.at(i).geometry).mesh->triangles.size();
}

std::string diffuse(const std::string& name, const std::string& grey) {
  return "<bsdf type='diffuse'" + (name.empty() ? "" : " name='" + name + "'") +
         "><spectrum name='reflectance' value='" + grey + "'/></bsdf>";
}

/// A scene with one part of a material that the library describes so.
ReadResult described(const std::string& lines) {
  MemoryFiles f = material_files();
  f.texts["/scene/meshes/two.obj"] = kVertices + "mtllib x.mtl\nusemtl a\nf 1 2 3\n";
  f.texts["/scene/meshes/x.mtl"] = "newmtl a\n" + lines;
  for (const char* name : {"/scene/meshes/wood.png", "/scene/bark.png"}) f.texts[name] = "image";
  return read("", f);
}

const BitmapTexture& bitmap(const ReadResult& r, TextureId id) {
  return std::get<BitmapTexture>(r.description().textures.at(size_t(id)).model);
}

}  // namespace

TEST_CASE("OBJ materials: a shape for each material of the library") {
  const ReadResult r = read("");
  CHECK(r.messages() == "");
  REQUIRE(r.scene);
  REQUIRE(r.description().shapes.size() == 2);
  CHECK(reflectance(r, 0) == ColorInput(Spectrum(1, 0, 0)));
  // Colours are sRGB.
  CHECK(reflectance(r, 1) == ColorInput(Spectrum(0, 0, srgb_to_linear(0.5f))));
  CHECK(triangles(r, 0) == 2);
  CHECK(triangles(r, 1) == 1);
  const TriangleMesh& red = *std::get<MeshShape>(r.description().shapes[0].geometry).mesh;
  CHECK(red.positions.at(red.triangles[1][1]) == Point3f(1, 0, 0));
  CHECK(red.positions.at(red.triangles[1][2]) == Point3f(0, 1, 0));
  CHECK(material_of(r, 0).label.text == "Red");
  CHECK(material_of(r, 0).where.to_string() == "/scene/meshes/materials/x.mtl:1:1");
  CHECK(r.description().materials.size() == 2);
  // Two shapes of the same library share its materials.
  const ReadResult twice = read_scene("0.6.0",
                                      shape() +
                                          "<shape type='obj'><string name='filename' "
                                          "value='meshes/two.obj'/></shape>",
                                      material_files());
  REQUIRE(twice.scene);
  CHECK(twice.description().materials.size() == 2);
  CHECK(twice.description().shapes.size() == 4);
}

TEST_CASE("OBJ materials: Mitsuba 3 does not read libraries, nor 0.x when told so") {
  for (const ReadResult& r : {read("", material_files(), "3.0.0"),
                              read("<boolean name='loadMaterials' value='false'/>")}) {
    CHECK(r.messages() == "");
    REQUIRE(r.scene);
    REQUIRE(r.description().shapes.size() == 1);
    CHECK(reflectance(r, 0) == ColorInput(Spectrum(0.5f)));
  }
}

TEST_CASE("OBJ materials: BSDFs of the scene replace them in the order of the scene") {
  const ReadResult all = read(diffuse("", "0.25"));
  CHECK(all.messages() == "");
  REQUIRE(all.description().shapes.size() == 1);
  CHECK(reflectance(all, 0) == ColorInput(Spectrum(0.25f)));

  const ReadResult one = read(diffuse("Blue", "0.75"));
  CHECK(one.messages() == "");
  CHECK(reflectance(one, 0) == ColorInput(Spectrum(1, 0, 0)));
  CHECK(reflectance(one, 1) == ColorInput(Spectrum(0.75f)));

  const ReadResult after = read(diffuse("", "0.25") + diffuse("Blue", "0.75"));
  CHECK(reflectance(after, 0) == ColorInput(Spectrum(0.25f)));
  CHECK(reflectance(after, 1) == ColorInput(Spectrum(0.75f)));
  const ReadResult before = read(diffuse("Blue", "0.75") + diffuse("", "0.25"));
  REQUIRE(before.description().shapes.size() == 1);
  CHECK(reflectance(before, 0) == ColorInput(Spectrum(0.25f)));

  // Parts that end up with the same material are one shape.
  const ReadResult same = read_scene(
      "0.6.0",
      "<bsdf type='diffuse' id='m'/>" + shape("<ref name='Red' id='m'/><ref name='Blue' id='m'/>") +
          "<emitter type='constant'/>",
      material_files());
  CHECK(same.messages() == "");
  REQUIRE(same.description().shapes.size() == 1);
  CHECK(triangles(same, 0) == 3);

  CHECK(read(diffuse("red", "0.5")).has("uses a material called \"red\""));
  // The library is not looked for if nobody needs it.
  MemoryFiles without = material_files();
  without.texts.erase("/scene/meshes/materials/x.mtl");
  CHECK(read(diffuse("", "0.5"), without).messages() == "");
  CHECK(read(diffuse("Red", "0.5") + diffuse("Blue", "0.5"), without).messages() == "");
}

TEST_CASE("OBJ materials: what is missing is said and stands for something") {
  MemoryFiles without = material_files();
  without.texts.erase("/scene/meshes/materials/x.mtl");
  const ReadResult r = read("", without);
  CHECK(
      r.has("scene.xml:2:54: warning: /scene/meshes/two.obj: the material library is missing: "
            "file \"materials/x.mtl\" not found (looked in /scene/meshes, /scene)"));
  CHECK(reflectance(r, 0) == ColorInput(Spectrum(0.5f)));
  CHECK(r.description().shapes.size() == 1);
  CHECK(r.diagnostics.all().size() == 1);

  MemoryFiles other = material_files();
  other.texts["/scene/meshes/materials/x.mtl"] = "newmtl Red\nKd 1 0 0\n";
  const ReadResult half = read("", other);
  CHECK(half.has("the library \"materials/x.mtl\" has no material \"Blue\""));
  CHECK(reflectance(half, 1) == ColorInput(Spectrum(0.5f)));

  other.texts["/scene/meshes/materials/x.mtl"] = "newmtl Red\nKd 1 0 oops\n";
  const ReadResult broken = read("", other);
  CHECK(!broken.scene);
  CHECK(
      broken.has("scene.xml:2:54: error: /scene/meshes/materials/x.mtl:2: \"oops\" is not a "
                 "number (Kd)"));
  // A folder instead of a library.
  other.texts["/scene/meshes/materials/x.mtl/a"] = "";
  other.texts.erase("/scene/meshes/materials/x.mtl");
  CHECK(read("", other).has("x.mtl: cannot be read"));
}

TEST_CASE("OBJ materials: the illumination model chooses the BSDF") {
  const std::string glossy = "Kd 0.5 0.5 0.5\nKs 0.25 0.25 0.25\nNs 40\n";
  const ReadResult phong = described(glossy + "illum 2\n");
  CHECK(phong.messages() == "");
  const auto& m = model<PhongMaterial>(phong, 0);
  CHECK(m.exponent == FloatInput(40.0));
  CHECK(m.diffuse_reflectance == ColorInput(Spectrum(srgb_to_linear(0.5f))));
  CHECK(m.specular_reflectance == ColorInput(Spectrum(srgb_to_linear(0.25f))));
  for (const char* lines : {"", "illum 0\n", "illum 1\n", "illum 3\n", "illum 10\n"})
    CHECK(reflectance(described(glossy + lines), 0) == ColorInput(Spectrum(srgb_to_linear(0.5f))));
  // Without a highlight there is nothing glossy.
  model<DiffuseMaterial>(described("Kd 1 1 1\nKs 0 0 0\nNs 40\nillum 2\n"), 0);
  model<DiffuseMaterial>(described("Kd 1 1 1\nKs 1 1 1\nNs 0\nillum 2\n"), 0);
  model<DiffuseMaterial>(described("Kd 1 1 1\nKs 1 1 1\nillum 2\n"), 0);
  for (const char* n : {"4", "6", "7", "9"}) {
    const auto& glass = model<DielectricMaterial>(described(std::string("illum ") + n), 0);
    CHECK(std::get<double>(glass.eta) == doctest::Approx(1.5046 / 1.000277));
  }
  for (const char* n : {"5", "8"}) {
    const auto& metal = model<ConductorMaterial>(described(std::string("illum ") + n), 0);
    const auto expected = read_bsdf<ConductorMaterial>(
        "0.6.0", "<bsdf type='conductor'><string name='material' value='Al'/></bsdf>");
    CHECK(metal == expected);
  }
  CHECK(reflectance(described("illum 1"), 0) == ColorInput(Spectrum(0.0f)));
}

TEST_CASE("OBJ materials: images, from beside the OBJ file or the scene's folders") {
  const ReadResult r = described("map_Kd C:\\textures\\wood.png\nmap_d wood.png\nbump bark.png\n");
  CHECK(r.messages() == "");
  const auto& mask = model<MaskMaterial>(r, 0);
  CHECK(bitmap(r, std::get<TextureId>(mask.opacity)).file == "/scene/meshes/wood.png");
  const auto& materials = r.description().materials;
  const auto& bump = materials.at(size_t(mask.nested)).model.get<BumpMapMaterial>();
  CHECK(bitmap(r, std::get<TextureId>(bump.height)).file == "/scene/bark.png");
  CHECK(bitmap(r, std::get<TextureId>(bump.height)).raw);
  const auto& base = materials.at(size_t(bump.nested)).model.get<DiffuseMaterial>();
  const BitmapTexture& wood = bitmap(r, std::get<TextureId>(base.reflectance));
  CHECK(wood.file == "/scene/meshes/wood.png");
  CHECK_FALSE(wood.raw);

  // Or beside the library.
  MemoryFiles f = material_files();
  f.texts["/scene/meshes/materials/x.mtl"] = "newmtl Red\nmap_Kd red.png\nnewmtl Blue\n";
  f.texts["/scene/meshes/materials/red.png"] = "image";
  const ReadResult beside = read("", f);
  CHECK(beside.messages() == "");
  CHECK(bitmap(beside, std::get<TextureId>(reflectance(beside, 0))).file ==
        "/scene/meshes/materials/red.png");

  CHECK(model<MaskMaterial>(described("d 0.25\n"), 0).opacity == FloatInput(0.25));
  model<DiffuseMaterial>(described("d 1\n"), 0);

  const ReadResult missing = described("map_Kd none.png\nbump none.png\nKs 1 1 1\n");
  CHECK(
      missing.has("/scene/meshes/x.mtl:2:1: warning: file \"none.png\" not found (looked in "
                  "/scene/meshes, "));
  CHECK(missing.has("x.mtl:3:1: warning: "));
  CHECK(missing.has(": black instead"));
  CHECK(reflectance(missing, 0) == ColorInput(Spectrum(0.0f)));
}

TEST_CASE("OBJ materials: values are checked as those of the scene are") {
  CHECK(described("Kd 1 -1 1\n").has("x.mtl:2:1: error: the colour 1 "));
  CHECK(described("Kd 1 1 1e38\n").has("x.mtl:2:1: error: the colour is too bright"));
  const ReadResult bright = described("Kd 2 1 1\n");
  CHECK(bright.has("x.mtl:2:1: warning: the reflectance is greater than 1"));
  CHECK(std::get<Spectrum>(reflectance(bright, 0)).max() == doctest::Approx(0.99));
  CHECK(described("illum 2\nKs 1 1 1\nNs -1\n").has("x.mtl:4:1: error: an exponent must not be"));
  CHECK(described("illum 2\nKd 1 1 1\nKs 1 1 1\nNs 5\n").has("x.mtl:1:1: warning: "));
}

TEST_CASE("OBJ materials: parts by number, all as one, in their own place") {
  const ReadResult second = read("<integer name='shapeIndex' value='1'/>");
  CHECK(second.messages() == "");
  REQUIRE(second.description().shapes.size() == 1);
  CHECK(triangles(second, 0) == 1);
  CHECK(std::get<Spectrum>(reflectance(second, 0)).b > 0);
  CHECK(read("<integer name='shapeIndex' value='3'/>").has("there is none with index 3"));

  const ReadResult whole = read("<boolean name='collapse' value='true'/>");
  REQUIRE(whole.description().shapes.size() == 1);
  CHECK(triangles(whole, 0) == 3);
  CHECK(reflectance(whole, 0) == ColorInput(Spectrum(1, 0, 0)));

  const ReadResult moved = read(
      "<boolean name='recenter' value='true'/><boolean name='flipNormals' value='true'/>"
      "<transform name='toWorld'><scale value='2'/></transform><emitter type='area'/>");
  REQUIRE(moved.description().shapes.size() == 2);
  for (const ShapeDescription& s : moved.description().shapes) {
    CHECK(s.flip_normals);
    CHECK(s.emission);
    CHECK(s.to_world[0][0] == 2);
    CHECK(s.to_world[0][3] == -1);
    CHECK(s.label.text == "thing");
  }
  CHECK(read("<sensor type='irradiancemeter'/>").has("cannot stand in a shape of this place"));
  MemoryFiles single = material_files();
  single.texts["/scene/meshes/two.obj"] =
      kVertices + "mtllib materials/x.mtl\nusemtl Red\nf 1 2 3\n";
  const ReadResult meter = read("<sensor type='irradiancemeter'/>", single);
  INFO(meter.messages());
  REQUIRE(meter.scene);
  CHECK(meter.description().sensors.size() == 2);
}

TEST_CASE("OBJ materials: written for Mitsuba 3") {
  MemoryFiles f = material_files();
  f.texts["/scene/meshes/two.obj"] = kVertices + "mtllib materials/x.mtl\nusemtl Red\nf 1 2 3\n";
  const MitsubaXml one = write_mitsuba_xml(read("", f).description());
  CHECK(one.losses.empty());
  CHECK(one.text.find("<bsdf type=\"diffuse\" id=\"Red\">") != one.text.npos);
  for (const ReadResult& r : {read(""), read("<integer name='shapeIndex' value='0'/>")})
    CHECK(write_mitsuba_xml(r.description()).losses ==
          std::vector<std::string>{
              "parts of an OBJ file cannot be named in Mitsuba 3: each is the whole file"});
}
