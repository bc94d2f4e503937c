// What pbrt's materials have in common.
#include "pbrt/materials.h"

#include <algorithm>
#include <cmath>

#include "pbrt/vocabulary.h"
#include "values/text.h"

namespace duet::pbrt {

MaterialId two_sided(Values& v, MaterialId nested) {
  return v.reader().add_material(TwoSidedMaterial{nested, nested}, v.where());
}

double remapped_roughness(double roughness, Version version) {
  if (version == Version::v4) return std::sqrt(std::max(roughness, 0.0));
  const double x = std::log(std::max(roughness, 1e-3));
  return 1.62142 + x * (0.819955 + x * (0.1734 + x * (0.0171201 + x * 0.000640711)));
}

std::optional<Roughness> read_roughness(Values& v, std::string_view name, std::string_view name_u,
                                        std::string_view name_v) {
  const Version version = v.reader().version();
  const bool remap = v.boolean("remaproughness");
  const auto read = [&](std::string_view axis) -> FloatInput {
    const std::string_view used = v.has(axis) ? axis : name;
    const FloatInput input = v.float_input(used);
    if (const double* constant = std::get_if<double>(&input))
      return remap ? remapped_roughness(*constant, version) : std::max(*constant, 0.0);
    if (!remap) return input;
    const TextureFunction function =
        version == Version::v4 ? TextureFunction::root : TextureFunction::v3_roughness;
    return v.reader().add_texture(FunctionDescription{std::get<TextureId>(input), function},
                                  v.where(used));
  };
  Roughness r;
  r.distribution = MicrofacetDistribution::ggx_correlated;
  r.alpha_u = read(name_u);
  r.alpha_v = read(name_v);
  const double* a = std::get_if<double>(&r.alpha_u);
  const double* b = std::get_if<double>(&r.alpha_v);
  // pbrt's limits of what is smooth.
  if (a && b && std::max(*a, *b) < 1e-3) return std::nullopt;
  if (a) r.alpha_u = std::max(*a, 1e-4);
  if (b) r.alpha_v = std::max(*b, 1e-4);
  if (!a || !b || r.alpha_u != r.alpha_v) v.reader().count_texture();
  return r;
}

std::optional<Roughness> read_glass_roughness(Values& v, std::string_view name) {
  const auto is_zero = [&](std::string_view axis) {
    if (!v.has(axis)) return true;
    const FloatInput r = v.float_input(axis);
    const double* constant = std::get_if<double>(&r);
    return constant && *constant == 0;
  };
  if (is_zero("uroughness") && is_zero("vroughness") && is_zero(name)) return std::nullopt;
  return read_roughness(v, name);
}

ColorInput scaled(Values& v, const ColorInput& input, const Spectrum& scale) {
  if (const Spectrum* constant = std::get_if<Spectrum>(&input)) return *constant * scale;
  if (scale == Spectrum(1.0f)) return input;
  return v.reader().add_texture(ScaledTextureDescription{std::get<TextureId>(input), scale},
                                v.where());
}

MaterialId diffuse_both_ways(Values& v, const ColorInput& reflectance,
                             const ColorInput& transmittance) {
  Reader& reader = v.reader();
  // Half of each lobe chosen, or what keeps both within what a lobe can scatter.
  double share = 0.5;
  const Spectrum* r = std::get_if<Spectrum>(&reflectance);
  const Spectrum* t = std::get_if<Spectrum>(&transmittance);
  if (r && t) {
    const double sum = double(r->max()) + double(t->max());
    if (sum > 0) share = std::clamp(double(t->max()) / sum, 1e-3, 1 - 1e-3);
  }
  const MaterialId diffuse = reader.add_material(
      DiffuseMaterial{scaled(v, reflectance, Spectrum(float(1 / (1 - share))))}, v.where());
  const MaterialId through = reader.add_material(
      DiffuseTransmitterMaterial{scaled(v, transmittance, Spectrum(float(1 / share)))}, v.where());
  const MaterialId both = two_sided(v, diffuse);
  return reader.add_material(BlendMaterial{share, both, through}, v.where());
}

namespace {

/// The material with the bumps that it is given.
MaterialId with_bumps(Values& v, MaterialId material) {
  Reader& reader = v.reader();
  const char* bumps = reader.version() == Version::v3 ? "bumpmap" : "displacement";
  if (v.has(bumps)) {
    BumpMapMaterial bump;
    bump.height = v.float_input(bumps);
    bump.flip_invalid_normals = bump.use_shadowing_function = bump.drops_leaks = false;
    bump.follows_curvature = true;
    bump.nested = material;
    // A constant height changes nothing.
    if (std::holds_alternative<double>(bump.height)) return material;
    return reader.add_material(bump, v.where(bumps));
  }
  if (reader.version() == Version::v4 && v.has("normalmap")) {
    BitmapTexture image;
    image.file = v.file("normalmap");
    if (image.file.empty()) return material;
    image.raw = true;
    image.to_uv.m = {{{1, 0, 0}, {0, -1, 1}}};
    NormalMapMaterial normals;
    normals.normals = reader.add_texture(image, v.where("normalmap"));
    normals.flip_invalid_normals = normals.use_shadowing_function = normals.drops_leaks = false;
    normals.nested = material;
    reader.count_texture();
    return reader.add_material(normals, v.where("normalmap"));
  }
  return material;
}

}  // namespace

std::optional<MaterialId> read_material(Reader& reader, const Plugin& plugin) {
  const bool is_v3 = reader.version() == Version::v3;
  const auto table = is_v3 ? materials_v3() : materials_v4(),
             others = is_v3 ? materials_v4() : materials_v3();
  const auto has_name = [&](const Record<ReadMaterial>& r) { return r.name == plugin.name; };
  if (is_v3 && std::none_of(table.begin(), table.end(), has_name) &&
      std::none_of(others.begin(), others.end(), has_name)) {
    reader.approximate(plugin.where, fmt::format("material {}, which there is not, by matte, as in "
                                                 "pbrt-v3",
                                                 in_quotes(plugin.name)));
    Plugin matte = plugin;
    matte.name = "matte";
    return read_material(reader, matte);
  }
  const Record<ReadMaterial>* record = find_record(reader, plugin, table, others);
  if (!record) return std::nullopt;
  if (record->status == Status::approximated)
    reader.approximate(plugin.where, fmt::format("material {}: {}", record->name, record->note));
  const size_t textures = reader.texture_count();
  Values v(reader, plugin, record->parameters, kMaterialSpecs);
  auto made = record->read(v);
  if (!made) return std::nullopt;
  const MaterialId plain = *made;
  made = with_bumps(v, *made);
  if (*made != plain) reader.share_interior(plain, *made);
  reader.set_looks_at_uv(*made, reader.texture_count() != textures);
  return made;
}

void list_materials(std::vector<Row>& rows) {
  list(rows, "Material", materials_v4(), kMaterialSpecs);
  list(rows, "Material", materials_v3(), kMaterialSpecs);
}

}  // namespace duet::pbrt
