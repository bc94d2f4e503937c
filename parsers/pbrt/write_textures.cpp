// Textures as pbrt-v4 writes them: images, and what is made of other textures.
#include <algorithm>

#include "pbrt/scene_writer.h"

namespace duet::pbrt {

namespace {

bool is_grey_color(const Spectrum& c) {
  return c.r == c.g && c.g == c.b;
}

}  // namespace

void SceneWriter::put(Statement& s, std::string_view name, const ColorInput& value,
                      bool is_reflectance) {
  if (const TextureId* id = std::get_if<TextureId>(&value)) {
    s.refer(name, texture(*id, true));
    return;
  }
  Spectrum color = std::get<Spectrum>(value);
  if (is_reflectance && color.max() > 1) {
    lose("reflectances above 1 become 1");
    for (int c = 0; c < 3; ++c) color[c] = std::min(color[c], 1.0f);
  }
  s.color(name, color);
}

void SceneWriter::put(Statement& s, std::string_view name, const FloatInput& value) {
  if (const TextureId* id = std::get_if<TextureId>(&value))
    s.refer(name, texture(*id, false));
  else
    s.number(name, std::get<double>(value));
}

void SceneWriter::input(Statement& s, std::string_view name, const ColorInput& value,
                        const Target& target) {
  if (const TextureId* id = std::get_if<TextureId>(&value))
    s.refer(name, texture(*id, target.is_color));
  else if (target.is_color)
    s.color(name, std::get<Spectrum>(value));
  else
    s.number(name, double(std::get<Spectrum>(value).luminance()));
}

bool SceneWriter::is_grey(const ColorInput& input) const {
  if (const Spectrum* constant = std::get_if<Spectrum>(&input)) return is_grey_color(*constant);
  const auto look = [&]<class T>(const T& t) {
    if constexpr (std::is_same_v<T, BitmapTexture>)
      return t.channel != TextureChannel::all;
    else if constexpr (std::is_same_v<T, NoiseTextureDescription>)
      return true;
    else if constexpr (std::is_same_v<T, ScaledTextureDescription>)
      return is_grey_color(t.scale) && is_grey(t.inner);
    else if constexpr (requires { t.inner; })
      return is_grey(t.inner);
    else if constexpr (requires { t.first; })
      return is_grey(t.first) && is_grey(t.second);
    else if constexpr (requires { t.color0; })
      return is_grey(t.color0) && is_grey(t.color1);
    else if constexpr (requires { t.inside; })
      return is_grey(t.inside) && is_grey(t.outside);
    else
      return false;
  };
  return std::visit(look, d_.textures[size_t(std::get<TextureId>(input))].model);
}

void SceneWriter::add_texture(const Statement& s, const std::optional<Matrix4>& to_world) {
  const bool moved = to_world && *to_world != Matrix4{};
  if (moved) textures_text_ += transform_text(*to_world);
  textures_text_ += s.text();
  if (moved) textures_text_ += "Identity\n";
}

SceneWriter::Scaling SceneWriter::scaling(const UvTransform& t) {
  if (t.m[0][1] != 0 || t.m[1][0] != 0) lose("texture coordinates are neither turned nor sheared");
  return {t.m[0][0], t.m[0][2], t.m[1][1], t.m[1][2]};
}

std::optional<Matrix4> SceneWriter::mapping(Statement& s, const Scaling& m,
                                            const MappedTextureDescription* map) {
  if (!map) {
    if (m.u_scale != 1) s.number("uscale", m.u_scale);
    if (m.v_scale != 1) s.number("vscale", m.v_scale);
    if (m.u_delta != 0) s.number("udelta", m.u_delta);
    if (m.v_delta != 0) s.number("vdelta", m.v_delta);
    return std::nullopt;
  }
  if (map->kind == SpaceMapKind::planar) {
    const auto& [a, b, c, d] = map->from_world.m;
    s.string("mapping", "planar");
    s.vector("v1", {m.u_scale * a[0], m.u_scale * a[1], m.u_scale * a[2]});
    s.vector("v2", {m.v_scale * b[0], m.v_scale * b[1], m.v_scale * b[2]});
    s.number("udelta", m.u_scale * a[3] + m.u_delta);
    s.number("vdelta", m.v_scale * b[3] + m.v_delta);
    return std::nullopt;
  }
  s.string("mapping", map->kind == SpaceMapKind::spherical ? "spherical" : "cylindrical");
  if (m.u_scale != 1 || m.v_scale != 1 || m.u_delta != 0 || m.v_delta != 0)
    lose("coordinates around a sphere or a cylinder are not scaled");
  return map->from_world.inverse();
}

void SceneWriter::image(Statement& s, const BitmapTexture& b, bool is_color) {
  s.string("filename", b.file);
  if (b.filter == TextureFilter::nearest) s.string("filter", "point");
  if (b.wrap_u != b.wrap_v) lose("a texture with different wrap modes in u and v has that of u");
  if (b.wrap_u == WrapMode::clamp) s.string("wrap", "clamp");
  if (b.wrap_u == WrapMode::zero) s.string("wrap", "black");
  if (b.wrap_u == WrapMode::mirror || b.wrap_u == WrapMode::one)
    lose("a texture that is mirrored, or one outside of its image, is repeated instead");
  if (!is_color && b.channel == TextureChannel::all)
    lose("a number of an image in colours is their mean, or its alpha if it has one");
  else if (b.channel != TextureChannel::all && (is_color || b.channel != TextureChannel::number))
    lose("the choice of one channel of a texture is missing");
  const bool png = b.file.ends_with(".png") || b.file.ends_with(".PNG");
  const double gamma = b.raw ? 1 : b.gamma.value_or(-1);
  if (png && gamma != -1)
    s.string("encoding", gamma == 1 ? "linear" : fmt::format("gamma {}", gamma));
  const bool is_8_bit = b.file.ends_with(".jpg") || b.file.ends_with(".jpeg") ||
                        b.file.ends_with(".tga") || b.file.ends_with(".bmp");
  if (!png && (is_8_bit ? gamma != -1 : b.gamma.value_or(1) != 1))
    lose("pbrt decodes images that are no PNG files by their formats alone");
}

std::string SceneWriter::texture(TextureId id, bool is_color) {
  const std::string name = fmt::format("texture{}", uint32_t(id));
  if (textures_.insert({id, is_color}).second)
    texture(d_.textures[size_t(id)], {name, is_color, nullptr});
  return name;
}

void SceneWriter::texture(const TextureDescription& t, const Target& target) {
  const auto write_it = [&]<class T>(const T& m) {
    if constexpr (requires { this->write(m, target); }) {
      this->write(m, target);
    } else {
      lose(fmt::format("the texture \"{}\" does not exist in pbrt: it is grey", m.name()));
      Statement s = target.begin("constant");
      input(s, "value", ColorInput(Spectrum(0.5f)), target);
      add_texture(s, {});
    }
  };
  std::visit(write_it, t.model);
}

void SceneWriter::write(const BitmapTexture& t, const Target& target) {
  Statement s = target.begin("imagemap");
  image(s, t, target.is_color);
  // The first row of an image is at t = 1.
  Scaling c = scaling(t.to_uv);
  c.v_scale = -c.v_scale, c.v_delta = 1 - c.v_delta;
  const auto to_world = mapping(s, c, target.map);
  add_texture(s, to_world);
}

void SceneWriter::write(const MappedTextureDescription& t, const Target& target) {
  texture(d_.textures[size_t(t.inner)], {target.name, target.is_color, &t});
}

void SceneWriter::write(const ScaledTextureDescription& t, const Target& target) {
  const bool grey = is_grey_color(t.scale);
  if (target.is_color && !grey) lose("the colour that multiplies a texture becomes grey");
  Statement s = target.begin("scale");
  s.refer("tex", texture(t.inner, target.is_color));
  s.number("scale", grey ? t.scale.r : t.scale.luminance());
  add_texture(s, {});
}

void SceneWriter::write(const ProductDescription& t, const Target& target) {
  Statement s = target.begin("scale");
  input(s, "tex", t.first, target);
  if (const TextureId* factor = std::get_if<TextureId>(&t.second))
    s.refer("scale", texture(*factor, false));
  else
    s.number("scale", double(std::get<Spectrum>(t.second).luminance()));
  if (target.is_color && !is_grey(t.second))
    lose("the second factor of a product of textures counts as a number");
  add_texture(s, {});
}

void SceneWriter::write(const MixDescription& t, const Target& target) {
  if (write_mapped_pattern(t, target)) return;
  Statement s = target.begin("mix");
  input(s, "tex1", t.first, target);
  input(s, "tex2", t.second, target);
  put(s, "amount", t.amount);
  add_texture(s, {});
}

void SceneWriter::write(const DirectionMixDescription& t, const Target& target) {
  Statement s = target.begin("directionmix");
  input(s, "tex1", t.first, target);
  input(s, "tex2", t.second, target);
  s.vector("dir", {t.x, t.y, t.z});
  add_texture(s, {});
}

bool SceneWriter::write_image(const FunctionDescription& t, const Target& target) {
  const TextureDescription* in = &d_.textures[size_t(t.inner)];
  const auto step = [&]<class T>(const T* outer) {
    if (outer) in = &d_.textures[size_t(outer->inner)];
    return outer;
  };
  if (t.function != TextureFunction::inverse) return false;
  const auto* scaled = step(std::get_if<ScaledTextureDescription>(&in->model));
  const auto* map = step(std::get_if<MappedTextureDescription>(&in->model));
  const auto* b = std::get_if<BitmapTexture>(&in->model);
  const double scale = scaled ? double(scaled->scale.r) : 1;
  if (!b || (scaled && !is_grey_color(scaled->scale))) return false;
  Statement s = target.begin("imagemap");
  image(s, *b, target.is_color);
  if (scaled) s.number("scale", scale);
  s.boolean("invert", true);
  Scaling c = scaling(b->to_uv);
  c.v_scale = -c.v_scale, c.v_delta = 1 - c.v_delta;
  const auto to_world = mapping(s, c, map);
  add_texture(s, to_world);
  return true;
}

void SceneWriter::write(const FunctionDescription& t, const Target& target) {
  const auto* inner = std::get_if<FunctionDescription>(&d_.textures[size_t(t.inner)].model);
  const bool inverse = t.function == TextureFunction::inverse;
  if (inverse && target.is_color && inner && inner->function == t.function) {
    // Within [0, 1], which pbrt's materials see to themselves.
    texture(d_.textures[size_t(inner->inner)], target);
    return;
  }
  if (write_image(t, target)) return;
  if (!inverse) lose("a function of a texture is missing where it is not a roughness");
  if (target.is_color && !is_grey(t.inner)) lose("a texture that is inverted becomes grey");
  // 1 − x between 1 and 0.
  Statement s = target.begin("mix");
  input(s, "tex1", Spectrum(inverse ? 1.0f : 0.0f), target);
  input(s, "tex2", Spectrum(inverse ? 0.0f : 1.0f), target);
  s.refer("amount", texture(t.inner, false));
  add_texture(s, {});
}

}  // namespace duet::pbrt
