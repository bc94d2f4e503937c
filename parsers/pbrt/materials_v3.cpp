// Materials of pbrt-v3.
#include <cmath>

#include "pbrt/materials.h"

namespace duet::pbrt {

namespace {

using enum Status;

#define DUET_ROUGHNESS_SPECS(preset)                                                             \
  {"roughness", kNumberTexture, preset}, {"uroughness", kNumberTexture},                         \
      {"vroughness", kNumberTexture}, {                                                          \
    "remaproughness", kBoolean, "true", "a polynomial of the roughness's logarithm is its alpha" \
  }

constexpr Spec kMatte[] = {{"Kd", kColorTexture, "0.5"},
                           {"sigma", kNumberTexture, "0", "Oren and Nayar's, in degrees"}};

std::optional<MaterialId> read_matte(Values& v) {
  const ColorInput reflectance = v.color_input("Kd", ColorMeaning::reflectance);
  const FloatInput sigma = v.float_input("sigma");
  const double* constant = std::get_if<double>(&sigma);
  if (!constant || *constant > 0) {
    RoughDiffuseMaterial m;
    m.reflectance = reflectance;
    // Mitsuba's alpha is that of a Beckmann distribution: √2 times the slopes' deviation.
    const double per_degree = 3.14159265358979 / 180 * std::sqrt(2.0);
    if (constant)
      m.alpha = *constant * per_degree;
    else
      m.alpha = v.reader().add_texture(
          ScaledTextureDescription{std::get<TextureId>(sigma), Spectrum(float(per_degree))},
          v.where("sigma"));
    m.use_fast_approx = true;
    return two_sided(v, v.reader().add_material(m, v.where()));
  }
  return two_sided(v, v.reader().add_material(DiffuseMaterial{reflectance}, v.where()));
}

constexpr Spec kMetal[] = {{"eta", kColorTexture, "metal-Cu-eta"},
                           {"k", kColorTexture, "metal-Cu-k"},
                           DUET_ROUGHNESS_SPECS("0.01")};

std::optional<MaterialId> read_metal(Values& v) {
  ConductorMaterial m;
  m.eta = v.color_input("eta", ColorMeaning::unbounded);
  m.k = v.color_input("k", ColorMeaning::unbounded);
  m.roughness = read_roughness(v);
  return two_sided(v, v.reader().add_material(m, v.where()));
}

constexpr Spec kMirror[] = {{"Kr", kColorTexture, "0.9"}};

std::optional<MaterialId> read_mirror(Values& v) {
  ConductorMaterial m;
  m.specular_reflectance = v.color_input("Kr", ColorMeaning::reflectance);
  return two_sided(v, v.reader().add_material(m, v.where()));
}

constexpr Spec kGlass[] = {{"Kr", kColorTexture, "1"},
                           {"Kt", kColorTexture, "1"},
                           {"eta", kNumberTexture, "1.5"},
                           {"index", kNumberTexture, "1.5"},
                           DUET_ROUGHNESS_SPECS("0")};

std::optional<MaterialId> read_glass(Values& v) {
  DielectricMaterial m;
  m.specular_reflectance = v.color_input("Kr", ColorMeaning::reflectance);
  m.specular_transmittance = v.color_input("Kt", ColorMeaning::reflectance);
  m.eta = v.index_of_refraction(v.has("eta") ? "eta" : "index");
  m.roughness = read_glass_roughness(v, "roughness");
  return v.reader().add_material(m, v.where());
}

/// Always rough: a smooth one has the least width that there is.
Roughness rough(Values& v) {
  const auto r = read_roughness(v);
  if (r) return *r;
  return {.distribution = MicrofacetDistribution::ggx_correlated, .alpha_u = 1e-3, .alpha_v = 1e-3};
}

constexpr Spec kPlastic[] = {
    {"Kd", kColorTexture, "0.25"}, {"Ks", kColorTexture, "0.25"}, DUET_ROUGHNESS_SPECS("0.1")};

std::optional<MaterialId> read_plastic(Values& v) {
  UberMaterial m;
  m.diffuse_reflectance = v.color_input("Kd", ColorMeaning::reflectance);
  m.glossy_reflectance = v.color_input("Ks", ColorMeaning::reflectance);
  // pbrt-v3 gives Fresnel's formula the two indices the other way round here (plastic.cpp), and
  // its images show it.
  m.eta = 1 / 1.5;
  m.roughness = rough(v);
  return v.reader().add_material(m, v.where());
}

constexpr Spec kUber[] = {{"Kd", kColorTexture, "0.25"},    {"Ks", kColorTexture, "0.25"},
                          {"Kr", kColorTexture, "0"},       {"Kt", kColorTexture, "0"},
                          {"opacity", kColorTexture, "1"},  {"eta", kNumberTexture, "1.5"},
                          {"index", kNumberTexture, "1.5"}, DUET_ROUGHNESS_SPECS("0.1")};

std::optional<MaterialId> read_uber(Values& v) {
  UberMaterial m;
  m.diffuse_reflectance = v.color_input("Kd", ColorMeaning::reflectance);
  m.glossy_reflectance = v.color_input("Ks", ColorMeaning::reflectance);
  m.specular_reflectance = v.color_input("Kr", ColorMeaning::reflectance);
  m.specular_transmittance = v.color_input("Kt", ColorMeaning::reflectance);
  m.opacity = v.color_input("opacity", ColorMeaning::reflectance);
  m.eta = v.float_input(v.has("eta") ? "eta" : "index");
  m.roughness = rough(v);
  return v.reader().add_material(m, v.where());
}

constexpr Spec kTranslucent[] = {{"Kd", kColorTexture, "0.25"},
                                 {"Ks", kColorTexture, "0.25"},
                                 {"reflect", kColorTexture, "0.5"},
                                 {"transmit", kColorTexture, "0.5"},
                                 DUET_ROUGHNESS_SPECS("0.1")};

/// A lobe's share of what is reflected or transmitted.
ColorInput share_of(Values& v, const ColorInput& lobe, const char* name) {
  const ColorInput share = v.color_input(name, ColorMeaning::reflectance);
  if (const Spectrum* constant = std::get_if<Spectrum>(&share)) return scaled(v, lobe, *constant);
  if (const Spectrum* constant = std::get_if<Spectrum>(&lobe)) return scaled(v, share, *constant);
  return v.reader().add_texture(ProductDescription{lobe, share}, v.where(name));
}

std::optional<MaterialId> read_translucent(Values& v) {
  UberMaterial m;
  const ColorInput diffuse = v.color_input("Kd", ColorMeaning::reflectance),
                   glossy = v.color_input("Ks", ColorMeaning::reflectance);
  m.diffuse_reflectance = share_of(v, diffuse, "reflect");
  m.diffuse_transmittance = share_of(v, diffuse, "transmit");
  m.glossy_reflectance = share_of(v, glossy, "reflect");
  m.glossy_transmittance = share_of(v, glossy, "transmit");
  m.roughness = rough(v);
  return v.reader().add_material(m, v.where());
}

constexpr Spec kSubstrate[] = {{"Kd", kColorTexture, "0.5"},
                               {"Ks", kColorTexture, "0.5"},
                               {"uroughness", kNumberTexture, "0.1"},
                               {"vroughness", kNumberTexture, "0.1"},
                               {"remaproughness", kBoolean, "true"}};

std::optional<MaterialId> read_substrate(Values& v) {
  SubstrateMaterial m;
  m.diffuse_reflectance = v.color_input("Kd", ColorMeaning::reflectance);
  m.specular_reflectance = v.color_input("Ks", ColorMeaning::reflectance);
  const auto r = read_roughness(v, "uroughness");
  m.roughness = r ? *r
                  : Roughness{.distribution = MicrofacetDistribution::ggx_correlated,
                              .alpha_u = 1e-3,
                              .alpha_v = 1e-3};
  return two_sided(v, v.reader().add_material(m, v.where()));
}

constexpr Spec kOldMix[] = {{"namedmaterial1", kString},
                            {"namedmaterial2", kString},
                            {"amount", kColorTexture, "0.5", "share of the first"}};

std::optional<MaterialId> read_old_mix(Values& v) {
  if (!v.has("namedmaterial1") || !v.has("namedmaterial2")) {
    v.reader().report().error(v.where(), "mix needs \"namedmaterial1\" and \"namedmaterial2\"");
    return std::nullopt;
  }
  BlendMaterial m;
  const Parameter* amount = v.given("amount");
  if (!amount) {
    m.weight = v.number("amount");
  } else {
    const ColorInput input = v.color_input("amount", ColorMeaning::reflectance);
    if (const Spectrum* c = std::get_if<Spectrum>(&input)) {
      if (c->r != c->g || c->g != c->b)
        v.reader().approximate(amount->where, "a mix of materials by a colour: by its luminance");
      m.weight = double(c->luminance());
    } else {
      m.weight = std::get<TextureId>(input);
    }
  }
  const auto named = [&](const char* name) {
    return v.reader().named_material(v.string(name), v.where(name));
  };
  m.first = named("namedmaterial2");
  m.second = named("namedmaterial1");
  v.reader().count_texture();
  return v.reader().add_material(m, v.where());
}

std::optional<MaterialId> read_none(Values& v) {
  return v.reader().add_material(NullMaterial{}, v.where());
}

const Record<ReadMaterial> kOldMaterials[] = {
    {"matte", Versions::v3, done, "", kMatte, read_matte},
    {"metal", Versions::v3, done, "", kMetal, read_metal},
    {"mirror", Versions::v3, done, "", kMirror, read_mirror},
    {"glass", Versions::v3, done, "", kGlass, read_glass},
    {"mix", Versions::v3, done, "", kOldMix, read_old_mix},
    {"none", Versions::v3, done, "", {}, read_none},
    {"", Versions::v3, done, "", {}, read_none},
    {"plastic", Versions::v3, done,
     "as in pbrt-v3, where the coat has the index 1/1.5 and reflects all light beyond 42 degrees",
     kPlastic, read_plastic},
    {"substrate", Versions::v3, done, "", kSubstrate, read_substrate},
    {"uber", Versions::v3, done, "", kUber, read_uber},
    {"translucent", Versions::v3, done, "", kTranslucent, read_translucent},
    {"hair", Versions::v3, done, "", hair_specs(), read_hair},
    {"disney", Versions::v3, approximated,
     "by Burley's model as Mitsuba has it; \"scatterdistance\" is left out", disney_specs(),
     read_disney},
    {"subsurface", Versions::v3, approximated, kWalkInstead, subsurface_specs(), read_subsurface},
    {"kdsubsurface", Versions::v3, approximated, kWalkInstead, kd_subsurface_specs(),
     read_kd_subsurface},
    {"fourier", Versions::v3, refused, "tables of Fourier coefficients", {}, nullptr},
};

#undef DUET_ROUGHNESS_SPECS

}  // namespace

std::span<const Record<ReadMaterial>> materials_v3() {
  return kOldMaterials;
}

}  // namespace duet::pbrt
