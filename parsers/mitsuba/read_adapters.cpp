// Materials made of other materials.
#include <algorithm>
#include <numeric>

#include "mitsuba/readers.h"
#include "mitsuba/scene_reader.h"
#include "mitsuba/text.h"

namespace duet {

namespace {

/// The nested materials; nothing, after an error, unless there are from `least` to `most` of them.
std::vector<MaterialId> nested(SceneReader& s, Properties& p, size_t least, size_t most) {
  const auto children = p.children(PluginKind::bsdf);
  if (children.size() < least || children.size() > most) {
    s.report().error(p.node().where, "{} needs {}{} nested BSDF{}, not {}", describe(p.node()),
                     least, least == most ? "" : " or " + std::to_string(most),
                     most == 1 ? "" : "s", children.size());
    return {};
  }
  std::vector<MaterialId> ids;
  for (const Properties::Child& child : children)
    if (const auto id = s.material(*child.node)) ids.push_back(*id);
  return ids.size() == children.size() ? ids : std::vector<MaterialId>();
}

bool is_zero(const FloatInput& input) {
  const double* value = std::get_if<double>(&input);
  return value && *value == 0;
}

/// Whether light passes through the material.
bool transmits(const SceneDescription& d, MaterialId id) {
  return std::visit(
      [&](const auto& m) -> bool {
        using M = std::decay_t<decltype(m)>;
        if constexpr (std::is_same_v<M, DielectricMaterial> ||
                      std::is_same_v<M, ThinDielectricMaterial> ||
                      std::is_same_v<M, MaskMaterial> || std::is_same_v<M, NullMaterial> ||
                      std::is_same_v<M, PrincipledThinMaterial> ||
                      std::is_same_v<M, DiffuseTransmitterMaterial> ||
                      std::is_same_v<M, HairMaterial> || std::is_same_v<M, FilterMaterial> ||
                      std::is_same_v<M, ThinLayerMaterial>)
          return true;
        else if constexpr (std::is_same_v<M, CoatingMaterial>)
          return transmits(d, m.nested);
        else if constexpr (std::is_same_v<M, PrincipledMaterial>)
          return !is_zero(m.spec_trans);
        else if constexpr (std::is_same_v<M, BlendMaterial>)
          return transmits(d, m.first) || transmits(d, m.second);
        else if constexpr (std::is_same_v<M, MixtureMaterial>)
          return std::any_of(m.parts.begin(), m.parts.end(),
                             [&](const auto& part) { return transmits(d, part.second); });
        else if constexpr (std::is_same_v<M, BumpMapMaterial> ||
                           std::is_same_v<M, NormalMapMaterial>)
          return transmits(d, m.nested);
        else
          return false;
      },
      d.materials[size_t(id)].model);
}

/// The one texture of an adapter: a parameter, which may be a colour as well, or nested without a
/// name that matters.
std::optional<ColorInput> only_texture(SceneReader& s, Properties& p, std::string_view name) {
  const auto children = p.children(PluginKind::texture);
  const bool named = !name.empty() && p.has(name);
  if (children.size() + (named ? 1 : 0) != 1) {
    s.report().error(p.node().where, "{} needs one texture, not {}", describe(p.node()),
                     children.size() + (named ? 1 : 0));
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

}  // namespace

void read_twosided(SceneReader& s, Properties& p, MaterialDescription& out) {
  const auto ids = nested(s, p, 1, 2);
  if (ids.empty()) return;
  // Light that passes such a surface would see one BSDF on its way and another on the way back.
  const bool allowed = p.boolean("allow_transmission");
  for (MaterialId id : ids)
    if (transmits(s.description(), id)) {
      s.report().error(p.node().where, "{} cannot hold a BSDF that lets light through{}",
                       describe(p.node()),
                       allowed ? " (\"allow_transmission\" is not supported)" : "");
      break;
    }
  out.model = TwoSidedMaterial{ids.front(), ids.back()};
}

void read_mask(SceneReader& s, Properties& p, MaterialDescription& out) {
  const FloatInput opacity = s.number_or_texture(p, "opacity");
  if (const auto ids = nested(s, p, 1, 1); !ids.empty()) out.model = MaskMaterial{opacity, ids[0]};
}

void read_blendbsdf(SceneReader& s, Properties& p, MaterialDescription& out) {
  const FloatInput weight = s.number_or_texture(p, "weight");
  if (const auto ids = nested(s, p, 2, 2); !ids.empty())
    out.model = BlendMaterial{weight, ids[0], ids[1]};
}

void read_mixturebsdf(SceneReader& s, Properties& p, MaterialDescription& out) {
  MixtureMaterial m;
  const std::string text = p.string("weights");
  const auto weights = parse_numbers(text);
  if (!weights || weights->empty() || *std::min_element(weights->begin(), weights->end()) < 0)
    return p.error("weights", "{} are not weights: numbers that are not negative", in_quotes(text));
  const double sum = std::accumulate(weights->begin(), weights->end(), 0.0);
  const auto ids = nested(s, p, weights->size(), weights->size());
  if (sum > 1)
    s.report().warning(p.where("weights"), "the weights sum to {:.4g}: they are divided by that",
                       sum);
  for (size_t i = 0; i < ids.size(); ++i)
    m.parts.emplace_back((*weights)[i] / std::max(sum, 1.0), ids[i]);
  out.model = m;
}

void read_bumpmap(SceneReader& s, Properties& p, MaterialDescription& out) {
  BumpMapMaterial m;
  m.scale = p.number("scale");
  m.flip_invalid_normals = p.boolean("flip_invalid_normals");
  m.use_shadowing_function = p.boolean("use_shadowing_function");
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
  const auto ids = nested(s, p, 1, 1);
  if (!height || ids.empty()) return;
  m.height = *height;
  m.nested = ids[0];
  out.model = m;
}

void read_normalmap(SceneReader& s, Properties& p, MaterialDescription& out) {
  NormalMapMaterial m;
  m.flip_invalid_normals = p.boolean("flip_invalid_normals");
  m.use_shadowing_function = p.boolean("use_shadowing_function");
  const auto normals = only_texture(s, p, "normalmap");
  const auto ids = nested(s, p, 1, 1);
  if (!normals || ids.empty()) return;
  m.normals = *normals;
  m.nested = ids[0];
  out.model = m;
}

}  // namespace duet
