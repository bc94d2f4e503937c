// Materials of pbrt-v4.
#include <algorithm>
#include <cmath>

#include "measured/measured_file.h"
#include "pbrt/materials.h"

namespace duet::pbrt {

namespace {

using enum Status;

#define DUET_ROUGHNESS_SPECS                                                          \
  {"roughness", kNumberTexture, "0"}, {"uroughness", kNumberTexture, "0"},            \
      {"vroughness", kNumberTexture, "0"}, {                                          \
    "remaproughness", kBoolean, "true", "the square root of a roughness is its alpha" \
  }

constexpr Spec kDiffuse[] = {{"reflectance", kColorTexture, "0.5"}};

std::optional<MaterialId> read_diffuse(Values& v) {
  const ColorInput reflectance = clamped_reflectance(v, "reflectance");
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

/// A metal is given by its index or by what it reflects.
void check_metal(Values& v, std::string_view eta, std::string_view k) {
  if (!v.has("reflectance")) return;
  for (const std::string_view name : {eta, k})
    if (v.has(name))
      v.reader().report().error(v.where(name),
                                "a metal has either \"reflectance\" or an index: \"{}\"", name);
}

std::optional<MaterialId> read_conductor(Values& v) {
  check_metal(v, "eta", "k");
  ConductorMaterial m;
  if (v.has("reflectance")) {
    const ColorInput r = reflectance_input(v, "reflectance");
    m.eta = Spectrum(1.0f);
    if (const Spectrum* constant = std::get_if<Spectrum>(&r))
      m.k = k_for(*constant);
    else
      m.k = v.reader().add_texture(
          FunctionDescription{std::get<TextureId>(r), TextureFunction::metal_k},
          v.where("reflectance"));
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
    return clamped(v, scaled(v, reflectance_input(v, name), scale));
  };
  return diffuse_both_ways(v, part("reflectance"), part("transmittance"));
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
  coat.albedo = reflectance_input(v, "albedo");
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
  m.reflectance = reflectance_input(v, "reflectance");
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
  check_metal(v, "conductor.eta", "conductor.k");
  CoatedConductorMaterial m;
  read_coat(
      v, m, "interface.eta",
      read_roughness(v, "interface.roughness", "interface.uroughness", "interface.vroughness"));
  if (v.has("reflectance")) {
    m.reflectance = reflectance_input(v, "reflectance");
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

constexpr Spec kMeasured[] = {{"filename", kString, "", "a .bsdf file; spectra become RGB"}};

std::optional<MaterialId> read_measured_material(Values& v) {
  if (!v.has("filename")) {
    v.reader().report().error(v.where(), "\"string filename\" is needed");
    return std::nullopt;
  }
  const std::string file = v.file("filename");
  if (file.empty()) return std::nullopt;
  try {
    MeasuredMaterial m{std::make_shared<MeasuredTable>(read_measured(file)), file};
    return two_sided(v, v.reader().add_material(m, v.where()));
  } catch (const ReadError& e) {
    v.reader().report().error(v.where("filename"), "{}", e.what());
  } catch (const std::bad_alloc&) {
    v.reader().report().error(v.where("filename"), "{} is too large for the memory", file);
  }
  return std::nullopt;
}

const Record<ReadMaterial> kMaterials[] = {
    {"diffuse", Versions::v4, done, "", kDiffuse, read_diffuse},
    {"conductor", Versions::v4, done, "", kConductor, read_conductor},
    {"dielectric", Versions::v4, done, "", kDielectric, read_dielectric},
    {"thindielectric", Versions::v4, done, "", kThin, read_thin_dielectric},
    {"diffusetransmission", Versions::v4, done, "", kTransmission, read_transmission},
    {"hair", Versions::v4, done, "", hair_specs(), read_hair},
    {"mix", Versions::v4, done, "", kMix, read_mix},
    {"interface", Versions::v4, done, "", {}, read_interface},
    {"none", Versions::v4, done, "", {}, read_interface},
    {"", Versions::v4, done, "", {}, read_interface},
    {"coateddiffuse", Versions::v4, done, "", kCoatedDiffuse, read_coated_diffuse},
    {"coatedconductor", Versions::v4, done, "", kCoatedConductor, read_coated_conductor},
    {"subsurface", Versions::v4, approximated, kWalkInstead, subsurface_specs(), read_subsurface},
    {"measured", Versions::v4, done, "", kMeasured, read_measured_material},
};

#undef DUET_ROUGHNESS_SPECS

}  // namespace

std::span<const Record<ReadMaterial>> materials_v4() {
  return kMaterials;
}

}  // namespace duet::pbrt
