// Equal for equal scenes, different for different ones.
#include "scene/content_hash.h"

#include <doctest/doctest.h>

#include "mitsuba/writer.h"
#include "support/files.h"
#include "support/memory_scene.h"

using namespace duet;
using namespace duet::test;

namespace {

SceneDescription scene(const std::string& content, const std::string& version = "3.0.0") {
  const ReadResult r = read_scene(version, content);
  REQUIRE_MESSAGE(r.scene, r.messages());
  return r.description();
}
ContentHash hash(const std::string& content, const std::string& version = "3.0.0") {
  return content_hash(scene(content, version));
}

const std::string kLamp = "<emitter type='constant'/>";
const std::string kBall = "<shape type='sphere'><ref id='a'/></shape>";
const std::string kRed =
    "<bsdf type='diffuse' id='a'><rgb name='reflectance' value='1 0 0'/></bsdf>";

}  // namespace

TEST_CASE("the content hash does not depend on how a scene is written") {
  const ContentHash expected = hash(kLamp + kRed + kBall);
  CHECK(expected.text().size() == 32);
  CHECK(hash(kLamp + kRed + kBall) == expected);
  // Places, labels, defaults, versions.
  CHECK(hash("\n\n" + kLamp +
             "<bsdf type='diffuse' id='b'><rgb name='reflectance' value='1,0,0'/>"
             "</bsdf><shape type='sphere' id='ball'><ref id='b'/></shape>") == expected);
  CHECK(hash("<emitter type='constant'><float name='sampling_weight' value='1'/></emitter>" + kRed +
             kBall) == expected);
  // The order of materials, and those that nothing refers to.
  CHECK(hash(kLamp + "<bsdf type='plastic' id='z'/>" + kRed + kBall) == expected);
  const std::string glass = "<bsdf type='dielectric' id='g'/>";
  const std::string two = kBall + "<shape type='cube'><ref id='g'/></shape>";
  CHECK(hash(kLamp + kRed + glass + two) == hash(kLamp + glass + kRed + two));
  // A material that is written again where it is used.
  CHECK(hash(kLamp + kRed + kBall + kBall) ==
        hash(kLamp + kRed + kBall + "<shape type='sphere'>" + kRed.substr(0, 20) +
             kRed.substr(kRed.find("><")) + "</shape>"));
  // A value that has no meaning beside another one.
  const auto hair = [](double scale) {
    SceneDescription d;
    HairMaterial m;
    m.scale = scale;
    d.materials.push_back({{}, {}, m});
    d.shapes.push_back({});
    return content_hash(d);
  };
  CHECK(hair(1) == hair(2));
}

TEST_CASE("the content hash notices every difference") {
  std::vector<std::string> contents{kLamp + kRed + kBall};
  const auto also = [&](const std::string& content) { contents.push_back(content); };
  also(kLamp + kRed + kBall + kBall);
  also("<emitter type='constant'><float name='radiance' value='2'/></emitter>" + kRed + kBall);
  also("<emitter type='point'/>" + kRed + kBall);
  also(kLamp + kRed + "<shape type='disk'><ref id='a'/></shape>");
  also(kLamp + kRed + "<shape type='sphere'><float name='radius' value='2'/><ref id='a'/></shape>");
  also(kLamp + kRed +
       "<shape type='sphere'><boolean name='flip_normals' value='true'/><ref id='a'/></shape>");
  const auto bsdf = [&](const std::string& text) {
    also(kLamp + "<shape type='sphere'>" + text + "</shape>");
  };
  bsdf("<bsdf type='diffuse'><rgb name='reflectance' value='1 0 0.5'/></bsdf>");
  bsdf("<bsdf type='diffuse'><texture type='checkerboard' name='reflectance'/></bsdf>");
  bsdf(
      "<bsdf type='diffuse'><texture type='checkerboard' name='reflectance'>"
      "<float name='color0' value='0'/></texture></bsdf>");
  bsdf("<bsdf type='plastic'/>");
  bsdf("<bsdf type='roughplastic'/>");
  bsdf("<bsdf type='roughplastic'><float name='alpha' value='0.2'/></bsdf>");
  bsdf("<bsdf type='roughplastic'><string name='distribution' value='ggx'/></bsdf>");
  bsdf("<bsdf type='polarizer'/>");
  bsdf("<bsdf type='circular'/>");
  bsdf("<bsdf type='blendbsdf'><bsdf type='diffuse'/><bsdf type='plastic'/></bsdf>");
  bsdf("<bsdf type='blendbsdf'><bsdf type='plastic'/><bsdf type='diffuse'/></bsdf>");
  bsdf("<bsdf type='null'/><medium type='homogeneous' name='interior'/>");
  bsdf("<bsdf type='null'/><medium type='homogeneous' name='exterior'/>");
  bsdf(
      "<bsdf type='null'/><medium type='homogeneous' name='interior'>"
      "<phase type='hg'/></medium>");
  bsdf(
      "<bsdf type='null'/><medium type='homogeneous' name='interior'>"
      "<phase type='hg'><float name='g' value='0.1'/></phase></medium>");
  std::vector<ContentHash> hashes;
  for (const std::string& c : contents) hashes.push_back(hash(c));
  for (size_t i = 0; i < hashes.size(); ++i)
    for (size_t j = 0; j < i; ++j) {
      CAPTURE(contents[i]);
      CAPTURE(contents[j]);
      CHECK(hashes[i] != hashes[j]);
      CHECK(hashes[i].high != hashes[j].high);
      CHECK(hashes[i].low != hashes[j].low);
    }
}

TEST_CASE("the content hash sees the data of meshes and images, and not where they lie") {
  const auto mesh = [](float x) {
    SceneDescription d;
    TriangleMesh m = make_rectangle();
    m.positions[0].x = x;
    d.shapes.resize(1);
    d.shapes[0].geometry = MeshShape{std::make_shared<TriangleMesh>(std::move(m))};
    d.materials.resize(1);
    return d;
  };
  SceneDescription renamed = mesh(-1);
  std::get<MeshShape>(renamed.shapes[0].geometry).source->file = "elsewhere.ply";
  CHECK(content_hash(renamed) == content_hash(mesh(-1)));
  CHECK(content_hash(mesh(-1)) != content_hash(mesh(-1.5)));
  CHECK(content_hash(mesh(0.0f)) == content_hash(mesh(-0.0f)));

  const TemporaryDirectory folder;
  const auto image = [&](const std::string& name, const std::string& bytes) {
    SceneDescription d = mesh(0);
    d.textures.resize(1);
    BitmapTexture bitmap;
    bitmap.file = folder.write(name, bytes);
    d.textures[0].model = bitmap;
    d.materials[0].model = DiffuseMaterial{TextureId{0}};
    return content_hash(d);
  };
  const ContentHash first = image("a.png", "these are pixels");
  CHECK(image("b.png", "these are pixels") == first);
  CHECK(image("a.png", "these are others") != first);
}
