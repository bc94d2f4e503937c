// Textures and materials as Mitsuba 3 writes them.
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

std::string type_of(const MaterialDescription& m) {
  constexpr std::string_view names[] = {"diffuse",        "conductor",
                                        "dielectric",     "thindielectric",
                                        "plastic",        "principled",
                                        "principledthin", "twosided",
                                        "mask",           "blendbsdf",
                                        "bumpmap",        "normalmap",
                                        "null",           "phong",
                                        "ward",           "roughdiffuse",
                                        "difftrans",      "mixturebsdf",
                                        "hair",           "measured",
                                        "pplastic",       "",
                                        "coating",        "hk"};
  static_assert(std::size(names) == std::variant_size_v<decltype(m.model)>);
  if (const auto* filter = std::get_if<FilterMaterial>(&m.model)) {
    constexpr const char* kinds[] = {"polarizer", "retarder", "circular"};
    return kinds[size_t(filter->kind)];
  }
  const bool rough = std::visit(
      [](const auto& model) {
        if constexpr (requires { model.roughness->distribution; })
          return model.roughness.has_value();
        else
          return false;
      },
      m.model);
  return std::string(rough ? "rough" : "").append(names[m.model.index()]);
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

void SceneWriter::material(const MaterialDescription& m, const std::string& id) {
  out_.open("bsdf", type_of(m), {}, id);
  std::visit([&](const auto& model) { write_model(model); }, m.model);
  out_.close();
}

void SceneWriter::roughness(const std::optional<Roughness>& r, bool isotropic) {
  if (!r) return;
  out_.string("distribution", r->distribution == MicrofacetDistribution::ggx ? "ggx" : "beckmann");
  if (isotropic || r->alpha_u == r->alpha_v) {
    number("alpha", r->alpha_u);
  } else {
    number("alpha_u", r->alpha_u);
    number("alpha_v", r->alpha_v);
  }
  if (!r->sample_visible) out_.boolean("sample_visible", false);
}

void SceneWriter::write_model(const DiffuseMaterial& m) {
  color("reflectance", m.reflectance);
}

void SceneWriter::write_model(const ConductorMaterial& m) {
  color("eta", m.eta);
  color("k", m.k);
  color("specular_reflectance", m.specular_reflectance);
  roughness(m.roughness, false);
}

void SceneWriter::write_model(const DielectricMaterial& m) {
  number("int_ior", m.eta);
  out_.number("ext_ior", 1);
  color("specular_reflectance", m.specular_reflectance);
  color("specular_transmittance", m.specular_transmittance);
  roughness(m.roughness, false);
}

void SceneWriter::write_model(const ThinDielectricMaterial& m) {
  out_.number("int_ior", m.eta);
  out_.number("ext_ior", 1);
  color("specular_reflectance", m.specular_reflectance);
  color("specular_transmittance", m.specular_transmittance);
}

void SceneWriter::write_model(const PlasticMaterial& m) {
  out_.number("int_ior", m.eta);
  out_.number("ext_ior", 1);
  color("diffuse_reflectance", m.diffuse_reflectance);
  color("specular_reflectance", m.specular_reflectance);
  out_.boolean("nonlinear", m.nonlinear);
  roughness(m.roughness, true);
}

void SceneWriter::write_model(const PhongMaterial& m) {
  number("exponent", m.exponent);
  color("diffuse_reflectance", m.diffuse_reflectance);
  color("specular_reflectance", m.specular_reflectance);
}

void SceneWriter::write_model(const WardMaterial& m) {
  constexpr std::string_view kVariants[] = {"ward", "ward-duer", "balanced"};
  out_.string("variant", kVariants[size_t(m.variant)]);
  number("alpha_u", m.alpha_u);
  number("alpha_v", m.alpha_v);
  color("diffuse_reflectance", m.diffuse_reflectance);
  color("specular_reflectance", m.specular_reflectance);
}

void SceneWriter::write_model(const RoughDiffuseMaterial& m) {
  color("reflectance", m.reflectance);
  number("alpha", m.alpha);
  out_.boolean("use_fast_approx", m.use_fast_approx);
}

void SceneWriter::write_model(const DiffuseTransmitterMaterial& m) {
  color("transmittance", m.transmittance);
}

void SceneWriter::write_model(const MixtureMaterial& m) {
  std::vector<double> weights;
  for (const auto& [weight, id] : m.parts) weights.push_back(weight);
  out_.string("weights", fmt::format("{}", fmt::join(weights, ", ")));
  for (const auto& [weight, id] : m.parts) out_.reference({}, material_id(id));
}

void SceneWriter::write_model(const PrincipledMaterial& m) {
  color("base_color", m.base_color);
  number("roughness", m.roughness);
  number("anisotropic", m.anisotropic);
  number("metallic", m.metallic);
  number("spec_trans", m.spec_trans);
  if (m.specular)
    out_.number("specular", *m.specular);
  else
    out_.number("eta", m.eta);
  number("spec_tint", m.spec_tint);
  number("sheen", m.sheen);
  number("sheen_tint", m.sheen_tint);
  number("flatness", m.flatness);
  number("clearcoat", m.clearcoat);
  number("clearcoat_gloss", m.clearcoat_gloss);
  out_.number("diffuse_reflectance_sampling_rate", m.diffuse_reflectance_sampling_rate);
  out_.number("main_specular_sampling_rate", m.main_specular_sampling_rate);
  out_.number("clearcoat_sampling_rate", m.clearcoat_sampling_rate);
}

void SceneWriter::write_model(const PrincipledThinMaterial& m) {
  color("base_color", m.base_color);
  number("roughness", m.roughness);
  number("anisotropic", m.anisotropic);
  number("spec_trans", m.spec_trans);
  number("eta", m.eta);
  number("spec_tint", m.spec_tint);
  number("sheen", m.sheen);
  number("sheen_tint", m.sheen_tint);
  number("flatness", m.flatness);
  number("diff_trans", m.diff_trans);
  out_.number("specular_reflectance_sampling_rate", m.spec_reflectance_sampling_rate);
  out_.number("specular_transmittance_sampling_rate", m.spec_transmittance_sampling_rate);
  out_.number("diffuse_reflectance_sampling_rate", m.diffuse_reflectance_sampling_rate);
  out_.number("diffuse_transmittance_sampling_rate", m.diffuse_transmittance_sampling_rate);
}

void SceneWriter::write_model(const TwoSidedMaterial& m) {
  out_.reference({}, material_id(m.front));
  if (m.back != m.front) out_.reference({}, material_id(m.back));
}

void SceneWriter::write_model(const MaskMaterial& m) {
  number("opacity", m.opacity);
  out_.reference({}, material_id(m.nested));
}

void SceneWriter::write_model(const BlendMaterial& m) {
  number("weight", m.weight);
  out_.reference({}, material_id(m.first));
  out_.reference({}, material_id(m.second));
}

}  // namespace duet
