// Bump and normal maps, whose texture may have no name.
#include "mitsuba/plugins/bsdf.h"
#include "mitsuba/plugins/bsdfs.h"

namespace duet::plugins {

namespace {

/// The one texture of an adapter: a parameter, which may be a colour as well, or nested without a
/// name that matters.
std::optional<ColorInput> only_texture(SceneReader& s, Properties& p, std::string_view name) {
  const auto children = p.children(PluginKind::texture);
  const bool named = !name.empty() && p.has(name);
  if (children.size() + (named ? 1 : 0) != 1) {
    p.needs("one texture, not {}", children.size() + (named ? 1 : 0));
    return std::nullopt;
  }
  if (named) return s.color(p, name);
  return s.color(*children[0].node, ColorMeaning::reflectance);
}

/// The same as a number.
std::optional<FloatInput> only_number(SceneReader& s, Properties& p) {
  const auto input = only_texture(s, p, "");
  if (!input) return std::nullopt;
  if (const TextureId* id = std::get_if<TextureId>(&*input)) return *id;
  return double(std::get<Spectrum>(*input).mean());
}

void read_bumpmap(SceneReader& s, Properties& p, MaterialDescription& out) {
  BumpMapMaterial m;
  read_values(s, p, m);
  std::optional<FloatInput> height;
  // In 0.x the height is scaled by a texture around the texture.
  const auto children = p.children(PluginKind::texture);
  const Node* wrapper = children.size() == 1 ? children[0].node : nullptr;
  if (wrapper && wrapper->plugin && wrapper->plugin->name == "scale") {
    Properties scale(*wrapper, s.report());
    const Node* inner = scale.child(PluginKind::texture);
    const Spectrum factor = s.constant_color(scale, "scale");
    m.scale *= double(factor.r == factor.g && factor.g == factor.b ? factor.r : factor.luminance());
    scale.finish();
    if (const auto id = inner ? s.texture(*inner) : std::nullopt)
      height = *id;
    else if (!inner)
      s.report().error(wrapper->where, "{} needs a texture", describe(*wrapper));
  } else {
    height = only_number(s, p);
  }
  if (!read_nested(s, p, m) || !height) return;
  m.height = *height;
  out.model = m;
}

void read_normalmap(SceneReader& s, Properties& p, MaterialDescription& out) {
  NormalMapMaterial m;
  read_values(s, p, m);
  const auto normals = only_texture(s, p, "normalmap");
  if (!read_nested(s, p, m) || !normals) return;
  m.normals = *normals;
  out.model = m;
}

}  // namespace

Plugin bumpmap() {
  return bsdf<BumpMapMaterial>(
      {.reader = &read_bumpmap, .note = "holds a texture and a BSDF", .aliases = "bump"});
}

Plugin normalmap() {
  return bsdf<NormalMapMaterial>({.reader = &read_normalmap, .note = "holds a BSDF"});
}

}  // namespace duet::plugins
