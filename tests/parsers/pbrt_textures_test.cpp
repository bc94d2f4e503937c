// What pbrt's textures become when they stand in a Mitsuba file, and back.
#include <doctest/doctest.h>

#include "mitsuba/writer.h"
#include "parsers/plugin_checks.h"
#include "scene/build.h"
#include "scene/texture_uses.h"

using namespace duet;
using namespace duet::test;

namespace {

SceneDescription diffuse_ball(std::vector<TextureDescription> textures) {
  SceneDescription d =
      read_scene("3.0.0", "<emitter type='constant'/><shape type='sphere'/>").description();
  DiffuseMaterial m;
  m.reflectance = TextureId(textures.size() - 1);
  d.textures = std::move(textures);
  d.materials.at(0).model = m;
  return d;
}

/// Written and read again: the texture that the last one of the list becomes.
template <class T>
T written_and_read(const T& texture, std::vector<TextureDescription> before = {}) {
  before.push_back({{}, {}, texture});
  const SceneDescription d = diffuse_ball(std::move(before));
  const MitsubaXml xml = write_mitsuba_xml(d);
  CHECK(xml.losses.empty());
  const ReadResult r = read_text(xml.text);
  REQUIRE_MESSAGE(r.scene, r.messages());
  CHECK(r.messages() == "");
  return std::get<T>(r.description().textures.at(d.textures.size() - 1).model);
}

const TextureDescription kTwoSquares{{}, {}, CheckerboardTexture{}};

Matrix4 placed() {
  return Matrix4::translate(1, 2, 3) * Matrix4::scale(2, 0.5, 1);
}

}  // namespace

TEST_CASE("texture: those of pbrt with their defaults") {
  CHECK(texture<NoiseTextureDescription>("3.0.0", "noise") == NoiseTextureDescription{});
  CHECK(texture<SolidCheckerboardDescription>("3.0.0", "solid_checkerboard") ==
        SolidCheckerboardDescription{});
  CHECK(texture<MixDescription>("3.0.0", "mix") == MixDescription{});
  CHECK(texture<ProductDescription>("3.0.0", "product") == ProductDescription{});
  CHECK(texture<DirectionMixDescription>("3.0.0", "directionmix") == DirectionMixDescription{});
  CHECK(texture<BilerpDescription>("3.0.0", "bilerp") == BilerpDescription{});
  CHECK(texture<DotsDescription>("3.0.0", "dots") == DotsDescription{});
}

TEST_CASE("texture: those of pbrt are written and read") {
  for (const NoiseKind kind :
       {NoiseKind::fbm, NoiseKind::wrinkled, NoiseKind::windy, NoiseKind::marble}) {
    NoiseTextureDescription noise{kind, 5, 0.25, 1, 0.2, placed()};
    if (kind == NoiseKind::marble) noise.scale = 3, noise.variation = 0.5;
    CHECK(written_and_read(noise) == noise);
  }
  const SolidCheckerboardDescription solid{Spectrum(0.25f), Spectrum(0.5f), placed()};
  CHECK(written_and_read(solid) == solid);
  for (const SpaceMapKind kind :
       {SpaceMapKind::spherical, SpaceMapKind::cylindrical, SpaceMapKind::planar}) {
    const MappedTextureDescription mapped{TextureId{0}, kind, placed()};
    CHECK(written_and_read(mapped, {kTwoSquares}) == mapped);
  }
  const MixDescription mix{Spectrum(0.25f), TextureId{0}, TextureId{1}};
  CHECK(written_and_read(mix, {kTwoSquares, {{}, {}, NoiseTextureDescription{}}}) == mix);
  const ProductDescription product{TextureId{0}, Spectrum(0.5f, 0.25f, 1)};
  CHECK(written_and_read(product, {kTwoSquares}) == product);
  const DirectionMixDescription direction{Spectrum(0.5f), TextureId{0}, 1, 0, -2};
  CHECK(written_and_read(direction, {kTwoSquares}) == direction);
  for (const TextureFunction function :
       {TextureFunction::inverse, TextureFunction::root, TextureFunction::v3_roughness,
        TextureFunction::metal_k, TextureFunction::positive}) {
    const FunctionDescription f{TextureId{0}, function};
    CHECK(written_and_read(f, {kTwoSquares}) == f);
  }
  const BilerpDescription bilerp{Spectrum(0.5f),
                                 Spectrum(0.25f),
                                 Spectrum(1),
                                 Spectrum(0.75f),
                                 {{{{2, 0, 0.5}, {0, 4, 0.25}}}}};
  CHECK(written_and_read(bilerp) == bilerp);
  BilerpDescription repeats = bilerp;
  repeats.repeats = true;
  CHECK(written_and_read(repeats) == repeats);
  const DotsDescription dots{Spectrum(0.5f), TextureId{0}, {{{{9, 0, 0}, {0, 9, 0}}}}};
  CHECK(written_and_read(dots, {kTwoSquares}) == dots);
}

TEST_CASE("texture: a share is asked for as a number, what it mixes as colours") {
  const SceneDescription d =
      diffuse_ball({kTwoSquares,
                    {{}, {}, NoiseTextureDescription{}},
                    {{}, {}, MixDescription{TextureId{0}, Spectrum(1), TextureId{1}}}});
  const auto uses = texture_uses(d);
  CHECK(uses.at(0).as_color);
  CHECK(!uses.at(0).as_number);
  CHECK(uses.at(1).as_number);
  CHECK(!uses.at(1).as_color);
}

TEST_CASE("texture: a direction without length is refused") {
  DirectionMixDescription t;
  t.y = 0;
  SceneDescription d = diffuse_ball({{{}, {}, t}});
  Diagnostics diagnostics;
  CHECK(!build_scene(std::move(d), {}, diagnostics));
  CHECK(diagnostics.all().at(0).to_string().find("has no length") != std::string::npos);
}
