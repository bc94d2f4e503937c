// Materials of pbrt-v4.
#include <algorithm>
#include <cmath>

#include "pbrt/materials.h"

namespace duet::pbrt {

namespace {

using enum Status;

constexpr Types kIndex = kNumber | of(Type::spectrum);

#define DUET_ROUGHNESS_SPECS                                                          \
  {"roughness", kNumberTexture, "0"}, {"uroughness", kNumberTexture, "0"},            \
      {"vroughness", kNumberTexture, "0"}, {                                          \
    "remaproughness", kBoolean, "true", "the square root of a roughness is its alpha" \
  }

constexpr Spec kDiffuse[] = {{"reflectance", kColorTexture, "0.5"}};

std::optional<MaterialId> read_diffuse(Values& v) {
  const ColorInput reflectance = v.color_input("reflectance", ColorMeaning::reflectance);
  return two_sided(v, v.reader().add_material(DiffuseMaterial{reflectance}, v.where()));
}

constexpr Spec kConductor[] = {{"eta", kColorTexture, "metal-Cu-eta"},
                               {"k", kColorTexture, "metal-Cu-k"},
                               {"reflectance", kColorTexture, "", "instead of eta and k"},
                               DUET_ROUGHNESS_SPECS};

/// η = 1 and the k with which a metal reflects that much of what falls on it straight.
Spectrum k_for(const Spectrum& reflectance) {
  Spectrum k;
  for (int c = 0; c < 3; ++c) {
    const float r = std::min(std::max(reflectance[c], 0.0f), 0.9999f);
    k[c] = 2 * std::sqrt(r) / std::sqrt(1 - r);
  }
  return k;
}

std::optional<MaterialId> read_conductor(Values& v) {
  ConductorMaterial m;
  if (v.has("reflectance")) {
    const ColorInput r = v.color_input("reflectance", ColorMeaning::reflectance);
    if (const Spectrum* constant = std::get_if<Spectrum>(&r)) {
      m.eta = Spectrum(1.0f);
      m.k = k_for(*constant);
    } else {
      v.reader().approximate(v.where("reflectance"),
                             "a metal whose reflectance is a texture: the same at all angles");
      m.specular_reflectance = r;
    }
  } else {
    m.eta = v.color_input("eta", ColorMeaning::unbounded);
    m.k = v.color_input("k", ColorMeaning::unbounded);
  }
  m.roughness = read_roughness(v);
  return two_sided(v, v.reader().add_material(m, v.where()));
}

constexpr Spec kDielectric[] = {{"eta", kIndex, "1.5", "index of refraction"},
                                DUET_ROUGHNESS_SPECS};

std::optional<MaterialId> read_dielectric(Values& v) {
  DielectricMaterial m;
  m.eta = v.index_of_refraction("eta");
  m.roughness = read_roughness(v);
  return v.reader().add_material(m, v.where());
}

constexpr Spec kThin[] = {{"eta", kIndex, "1.5", "index of refraction"}};

std::optional<MaterialId> read_thin_dielectric(Values& v) {
  ThinDielectricMaterial m;
  m.eta = v.index_of_refraction("eta");
  return v.reader().add_material(m, v.where());
}

constexpr Spec kTransmission[] = {{"reflectance", kColorTexture, "0.25"},
                                  {"transmittance", kColorTexture, "0.25"},
                                  {"scale", kNumber, "1"}};

std::optional<MaterialId> read_transmission(Values& v) {
  const Spectrum scale(float(v.not_negative("scale")));
  const auto part = [&](const char* name) {
    return scaled(v, v.color_input(name, ColorMeaning::reflectance), scale);
  };
  return diffuse_both_ways(v, part("reflectance"), part("transmittance"));
}

constexpr Spec kHair[] = {
    {"sigma_a", kColorTexture, "", "absorption per radius"},
    {"reflectance", kColorTexture, "", "of many hairs"},
    {"color", kColorTexture, "", "the same"},
    {"eumelanin", kNumberTexture},
    {"pheomelanin", kNumberTexture},
    {"eta", kNumberTexture, "1.55"},
    {"beta_m", kNumberTexture, "0.3", "longitudinal roughness"},
    {"beta_n", kNumberTexture, "0.3", "azimuthal roughness"},
    {"alpha", kNumberTexture, "2", "tilt of the scales in degrees"},
};

/// A parameter that Duet's hair has as a number.
double hair_number(Values& v, const char* name) {
  const FloatInput input = v.float_input(name);
  if (const double* constant = std::get_if<double>(&input)) return *constant;
  v.reader().report().error(v.where(name), "textures of \"{}\" are not supported", name);
  return 0.3;
}

/// Absorption with which many hairs have this colour: Chiang et al., "A Practical and Controllable
/// Hair and Fur Model for Production Path Tracing", 2016, eq. 9.
Spectrum absorption_for(const Spectrum& color, double beta_n) {
  const double b = beta_n;
  const double d = 5.969 + b * (-0.215 + b * (2.532 + b * (-10.73 + b * (5.574 + b * 0.245))));
  Spectrum sigma;
  for (int c = 0; c < 3; ++c) {
    const double l = std::log(std::max(double(color[c]), 1e-4)) / d;
    sigma[c] = float(l * l);
  }
  return sigma;
}

std::optional<MaterialId> read_hair(Values& v) {
  HairMaterial m;
  m.longitudinal_roughness = std::min(std::max(hair_number(v, "beta_m"), 0.0), 1.0);
  m.azimuthal_roughness = std::min(std::max(hair_number(v, "beta_n"), 0.0), 1.0);
  m.scale_tilt = hair_number(v, "alpha");
  m.eta = hair_number(v, "eta");
  const char* color = v.has("reflectance") ? "reflectance" : "color";
  if (v.has("sigma_a")) {
    m.sigma_a = v.color_input("sigma_a", ColorMeaning::unbounded);
  } else if (v.has(color)) {
    const ColorInput input = v.color_input(color, ColorMeaning::reflectance);
    if (const Spectrum* constant = std::get_if<Spectrum>(&input))
      m.sigma_a = absorption_for(*constant, m.azimuthal_roughness);
    else
      v.reader().report().error(v.where(color), "textures of \"{}\" are not supported", color);
  } else {
    const bool given = v.has("eumelanin") || v.has("pheomelanin");
    const double eu = given ? hair_number(v, "eumelanin") : 1.3,
                 pheo = given ? hair_number(v, "pheomelanin") : 0;
    // Absorption of the two pigments per concentration: d'Eon et al. 2011.
    m.sigma_a =
        Spectrum(0.419f, 0.697f, 1.37f) * float(eu) + Spectrum(0.187f, 0.4f, 1.05f) * float(pheo);
  }
  return v.reader().add_material(m, v.where());
}

#define DUET_COAT_SPECS                                                                 \
  {"thickness", kNumberTexture, "0.01", "optical, of the layer between coat and base"}, \
      {"albedo", kColorTexture, "0", "of that layer"},                                  \
      {"g", kNumberTexture, "0", "mean cosine of its scattering"},                      \
      {"maxdepth", kInteger, "10", "events in the layer that are followed"},            \
      {"nsamples", kInteger, "1", "walks per value"}, {                                 \
    "remaproughness", kBoolean, "true", "the square root of a roughness is its alpha"   \
  }

/// The coat and what is under it.
void read_coat(Values& v, CoatLayer& coat, const char* eta, const std::optional<Roughness>& top) {
  coat.eta = v.index_of_refraction(eta);
  if (top) coat.alpha_u = top->alpha_u, coat.alpha_v = top->alpha_v;
  coat.thickness = v.float_input("thickness");
  coat.albedo = v.color_input("albedo", ColorMeaning::reflectance);
  coat.g = v.float_input("g");
  coat.max_depth = std::max(1, v.integer("maxdepth"));
  coat.samples = std::max(1, v.integer("nsamples"));
}

constexpr Spec kCoatedDiffuse[] = {{"reflectance", kColorTexture, "0.5", "of the base"},
                                   {"roughness", kNumberTexture, "0"},
                                   {"uroughness", kNumberTexture, "0"},
                                   {"vroughness", kNumberTexture, "0"},
                                   {"eta", kIndex, "1.5", "of the coat"},
                                   DUET_COAT_SPECS};

std::optional<MaterialId> read_coated_diffuse(Values& v) {
  CoatedDiffuseMaterial m;
  m.reflectance = v.color_input("reflectance", ColorMeaning::reflectance);
  read_coat(v, m, "eta", read_roughness(v));
  return two_sided(v, v.reader().add_material(m, v.where()));
}

constexpr Spec kCoatedConductor[] = {{"interface.roughness", kNumberTexture, "0", "of the coat"},
                                     {"interface.uroughness", kNumberTexture, "0"},
                                     {"interface.vroughness", kNumberTexture, "0"},
                                     {"interface.eta", kIndex, "1.5", "of the coat"},
                                     {"conductor.eta", kColorTexture, "metal-Cu-eta"},
                                     {"conductor.k", kColorTexture, "metal-Cu-k"},
                                     {"reflectance", kColorTexture, "", "instead of eta and k"},
                                     {"conductor.roughness", kNumberTexture, "0"},
                                     {"conductor.uroughness", kNumberTexture, "0"},
                                     {"conductor.vroughness", kNumberTexture, "0"},
                                     DUET_COAT_SPECS};

std::optional<MaterialId> read_coated_conductor(Values& v) {
  CoatedConductorMaterial m;
  read_coat(
      v, m, "interface.eta",
      read_roughness(v, "interface.roughness", "interface.uroughness", "interface.vroughness"));
  if (v.has("reflectance")) {
    m.reflectance = v.color_input("reflectance", ColorMeaning::reflectance);
  } else {
    m.conductor_eta = v.color_input("conductor.eta", ColorMeaning::unbounded);
    m.conductor_k = v.color_input("conductor.k", ColorMeaning::unbounded);
  }
  if (const auto base =
          read_roughness(v, "conductor.roughness", "conductor.uroughness", "conductor.vroughness"))
    m.conductor_alpha_u = base->alpha_u, m.conductor_alpha_v = base->alpha_v;
  return two_sided(v, v.reader().add_material(m, v.where()));
}

#undef DUET_COAT_SPECS

constexpr Spec kMix[] = {{"materials", kString, "", "two names", 2},
                         {"amount", kNumberTexture, "0.5", "share of the second"}};

std::optional<MaterialId> read_mix(Values& v) {
  const Parameter* names = v.given("materials");
  if (!names) {
    v.reader().report().error(v.where(), "\"string materials\" is needed: two names");
    return std::nullopt;
  }
  BlendMaterial m;
  m.weight = v.float_input("amount");
  m.first = v.reader().named_material(names->strings[0], names->where);
  m.second = v.reader().named_material(names->strings[1], names->where);
  v.reader().count_texture();
  return v.reader().add_material(m, v.where());
}

std::optional<MaterialId> read_interface(Values& v) {
  return v.reader().add_material(NullMaterial{}, v.where());
}

constexpr Spec kSubsurface[] = {{"sigma_a", kColorTexture, "0.0011 0.0024 0.014", "absorption"},
                                {"sigma_s", kColorTexture, "2.55 3.21 3.77", "scattering"},
                                {"scale", kNumber, "1", "of both"},
                                {"reflectance", kColorTexture, "", "of a thick layer, with mfp"},
                                {"mfp", kColorTexture, "1", "mean free path"},
                                {"name", kString, "", "of a known medium"},
                                {"eta", kIndex, "1.33", "index of refraction"},
                                {"g", kNumber, "0", "mean cosine of scattering"},
                                DUET_ROUGHNESS_SPECS};

std::optional<MaterialId> read_subsurface_v4(Values& v) {
  DielectricMaterial m;
  m.eta = v.index_of_refraction("eta");
  m.roughness = read_roughness(v);
  const auto medium = read_subsurface_medium(v, v.index_of_refraction("eta"));
  if (!medium) return std::nullopt;
  const MaterialId id = v.reader().add_material(m, v.where());
  v.reader().set_interior(id, *medium);
  return id;
}

constexpr Spec kMeasured[] = {{"filename", kString, "", "a .bsdf file in RGB"}};

constexpr Record<ReadMaterial> kMaterials[] = {
    {"diffuse", Versions::v4, done, "", kDiffuse, read_diffuse},
    {"conductor", Versions::v4, done, "", kConductor, read_conductor},
    {"dielectric", Versions::v4, done, "", kDielectric, read_dielectric},
    {"thindielectric", Versions::v4, done, "", kThin, read_thin_dielectric},
    {"diffusetransmission", Versions::v4, done, "", kTransmission, read_transmission},
    {"hair", Versions::v4, done, "", kHair, read_hair},
    {"mix", Versions::v4, done, "", kMix, read_mix},
    {"interface", Versions::v4, done, "", {}, read_interface},
    {"none", Versions::v4, done, "", {}, read_interface},
    {"", Versions::v4, done, "", {}, read_interface},
    {"coateddiffuse", Versions::v4, done, "", kCoatedDiffuse, read_coated_diffuse},
    {"coatedconductor", Versions::v4, done, "", kCoatedConductor, read_coated_conductor},
    {"subsurface", Versions::v4, approximated,
     "by random walks in a medium behind the surface, which pbrt replaces by a profile",
     kSubsurface, read_subsurface_v4},
    {"measured", Versions::v4, refused, "measured spectra", kMeasured, nullptr},
};

#undef DUET_ROUGHNESS_SPECS

}  // namespace

std::span<const Record<ReadMaterial>> materials_v4() {
  return kMaterials;
}

}  // namespace duet::pbrt
