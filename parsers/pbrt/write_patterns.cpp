// Textures that are patterns by formulas, as pbrt-v4 writes them.
#include "pbrt/scene_writer.h"

namespace duet::pbrt {

namespace {

/// pbrt's squares are twice as wide.
UvTransform doubled(UvTransform m) {
  for (auto& row : m.m)
    for (double& x : row) x *= 2;
  return m;
}

bool is_constant(const ColorInput& input, float value) {
  const Spectrum* c = std::get_if<Spectrum>(&input);
  return c && *c == Spectrum(value);
}

}  // namespace

void SceneWriter::write(const CheckerboardTexture& t, const Target& target) {
  Statement s = target.begin("checkerboard");
  const bool swap = t.swap_values && !target.is_color;
  input(s, "tex1", swap ? t.color1 : t.color0, target);
  input(s, "tex2", swap ? t.color0 : t.color1, target);
  const auto to_world = mapping(s, scaling(doubled(t.to_uv)), target.map);
  add_texture(s, to_world);
}

void SceneWriter::write(const DotsDescription& t, const Target& target) {
  Statement s = target.begin("dots");
  // pbrt's images have "inside" around the dots.
  input(s, "inside", t.outside, target);
  input(s, "outside", t.inside, target);
  const auto to_world = mapping(s, scaling(t.to_uv), target.map);
  add_texture(s, to_world);
}

bool SceneWriter::write_mapped_pattern(const MixDescription& t, const Target& target) {
  const TextureId* amount = std::get_if<TextureId>(&t.amount);
  const auto* map =
      amount ? std::get_if<MappedTextureDescription>(&d_.textures[size_t(*amount)].model) : nullptr;
  if (!map) return false;
  const auto& inner = d_.textures[size_t(map->inner)].model;
  if (const auto* board = std::get_if<CheckerboardTexture>(&inner)) {
    if (board->swap_values || !is_constant(board->color0, 0) || !is_constant(board->color1, 1))
      return false;
    Statement s = target.begin("checkerboard");
    input(s, "tex1", t.first, target);
    input(s, "tex2", t.second, target);
    const auto to_world = mapping(s, scaling(doubled(board->to_uv)), map);
    add_texture(s, to_world);
    return true;
  }
  const auto* dots = std::get_if<DotsDescription>(&inner);
  if (!dots || !is_constant(dots->outside, 0) || !is_constant(dots->inside, 1)) return false;
  Statement s = target.begin("dots");
  input(s, "inside", t.first, target);
  input(s, "outside", t.second, target);
  const auto to_world = mapping(s, scaling(dots->to_uv), map);
  add_texture(s, to_world);
  return true;
}

void SceneWriter::write(const BilerpDescription& t, const Target& target) {
  if (t.repeats) lose("a texture that is linear in each square of coordinates goes on beyond one");
  Statement s = target.begin("bilerp");
  input(s, "v00", t.v00, target);
  input(s, "v01", t.v01, target);
  input(s, "v10", t.v10, target);
  input(s, "v11", t.v11, target);
  const auto to_world = mapping(s, scaling(t.to_uv), target.map);
  add_texture(s, to_world);
}

void SceneWriter::write(const NoiseTextureDescription& t, const Target& target) {
  // Marble makes colours only, the others make numbers only.
  const bool makes_color = t.kind == NoiseKind::marble;
  if (makes_color && !target.is_color) {
    lose("numbers by the texture \"marble\" do not exist in pbrt-v4: they are 0.5");
    Statement even = target.begin("constant");
    add_texture(even.number("value", 0.5), {});
    return;
  }
  if (!makes_color && target.is_color) {
    const std::string number = target.name + "-number";
    write(t, {number, false, target.map});
    Statement mix = target.begin("mix");
    mix.color("tex1", Spectrum(0.0f)).color("tex2", Spectrum(1.0f)).refer("amount", number);
    add_texture(mix, {});
    return;
  }
  Statement s = target.begin(NoiseTextureDescription::kKinds[size_t(t.kind)]);
  if (t.kind != NoiseKind::windy) s.integer("octaves", t.octaves).number("roughness", t.roughness);
  if (t.kind == NoiseKind::marble) s.number("scale", t.scale).number("variation", t.variation);
  add_texture(s, t.from_world.inverse());
}

void SceneWriter::write(const SolidCheckerboardDescription& t, const Target& target) {
  Statement s = target.begin("checkerboard");
  s.integer("dimension", 3);
  input(s, "tex1", t.color0, target);
  input(s, "tex2", t.color1, target);
  add_texture(s, t.from_world.inverse());
}

}  // namespace duet::pbrt
