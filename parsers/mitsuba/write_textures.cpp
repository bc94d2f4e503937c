// Textures as Mitsuba 3 writes them.
#include "mitsuba/scene_writer.h"

namespace duet {

namespace {

std::string_view type_of(const TextureDescription& t) {
  constexpr std::string_view names[] = {"bitmap",      "checkerboard", "mesh_attribute",
                                        "gridtexture", "wireframe",    "curvature",
                                        "scale",       "volume"};
  static_assert(std::size(names) == std::variant_size_v<decltype(t.model)>);
  return names[t.model.index()];
}

}  // namespace

void SceneWriter::color(std::string_view name, const ColorInput& input) {
  if (const TextureId* id = std::get_if<TextureId>(&input))
    return out_.reference(name, texture_id(*id));
  const Spectrum& s = std::get<Spectrum>(input);
  // Mitsuba 3 refuses reflectances above 1 as <rgb>, not as numbers.
  if (s.r == s.g && s.g == s.b)
    out_.number(name, s.r);
  else
    out_.rgb(name, s);
}

void SceneWriter::number(std::string_view name, const FloatInput& input) {
  if (const TextureId* id = std::get_if<TextureId>(&input))
    out_.reference(name, texture_id(*id));
  else
    out_.number(name, std::get<double>(input));
}

void SceneWriter::uv_transform(const UvTransform& uv) {
  Matrix4 m;
  for (int i = 0; i < 2; ++i) m[i] = {uv.m[i][0], uv.m[i][1], 0, uv.m[i][2]};
  out_.transform("to_uv", m);
}

void SceneWriter::texture(size_t index) {
  const TextureDescription& t = d_.textures[index];
  out_.open("texture", type_of(t), {}, texture_ids_[index]);
  if (const auto* board = std::get_if<CheckerboardTexture>(&t.model);
      board && texture_uses_[index].as_number && !board->swap_values) {
    // Mitsuba 3 is going to exchange the values.
    CheckerboardTexture exchanged = *board;
    if (texture_uses_[index].as_color)
      lose("a checkerboard used as colour and as number has its numbers exchanged");
    else
      std::swap(exchanged.color0, exchanged.color1);
    write_model(exchanged);
  } else {
    std::visit([&](const auto& model) { write_model(model); }, t.model);
  }
  out_.close();
}

void SceneWriter::write_model(const BitmapTexture& t) {
  out_.string("filename", t.file);
  if (t.filter == TextureFilter::nearest) out_.string("filter_type", "nearest");
  constexpr std::string_view modes[] = {"repeat", "mirror", "clamp", "clamp", "clamp"};
  if (t.wrap_u != WrapMode::repeat) out_.string("wrap_mode", modes[size_t(t.wrap_u)]);
  if (t.wrap_u != t.wrap_v) lose("a texture with different wrap modes in u and v has that of u");
  if (t.wrap_u == WrapMode::zero || t.wrap_u == WrapMode::one)
    lose("a texture that is zero or one outside of its image is clamped instead");
  if (t.raw) out_.boolean("raw", true);
  if (t.gamma) lose("the gamma value of a texture is missing");
  if (t.channel != TextureChannel::all) lose("the choice of one channel of a texture is missing");
  uv_transform(t.to_uv);
}

void SceneWriter::write_model(const CheckerboardTexture& t) {
  color("color0", t.color0);
  color("color1", t.color1);
  uv_transform(t.to_uv);
}

void SceneWriter::write_model(const MeshAttributeTexture& t) {
  out_.string("name", t.attribute);
  if (t.scale != 1) out_.number("scale", t.scale);
}

void SceneWriter::write_model(const GridLinesTexture& t) {
  lose("the texture \"gridtexture\" does not exist in Mitsuba 3");
  color("color0", t.color0);
  color("color1", t.color1);
  out_.number("line_width", t.line_width);
  uv_transform(t.to_uv);
}

void SceneWriter::write_model(const WireframeTexture& t) {
  lose("the texture \"wireframe\" does not exist in Mitsuba 3");
  out_.rgb("interior_color", t.interior);
  out_.rgb("edge_color", t.edge);
  if (t.line_width) out_.number("line_width", *t.line_width);
  out_.number("step_width", t.step_width);
}

void SceneWriter::write_model(const CurvatureTexture& t) {
  lose("the texture \"curvature\" does not exist in Mitsuba 3");
  out_.string("curvature", t.shown == CurvatureKind::mean ? "mean" : "gaussian");
  out_.number("scale", t.scale);
}

void SceneWriter::write_model(const ScaledTextureDescription& t) {
  lose("the texture \"scale\" does not exist in Mitsuba 3");
  out_.rgb("scale", t.scale);
  out_.reference({}, texture_id(t.inner));
}

void SceneWriter::write_model(const VolumeTextureDescription& t) {
  volume("volume", ColorVolume(t.volume));
}

}  // namespace duet
