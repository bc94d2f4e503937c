// Hair: the same in both versions.
#include <algorithm>

#include "materials/hair_absorption.h"
#include "pbrt/materials.h"

namespace duet::pbrt {

namespace {

constexpr Spec kHair[] = {
    {"sigma_a", kColorTexture, "", "absorption per radius"},
    {"reflectance", kColorTexture, "", "of many hairs", 1, Status::done, Versions::v4},
    {"color", kColorTexture, "", "of many hairs"},
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

/// The concentration of a pigment.
FloatInput pigment(Values& v, const char* name) {
  if (!v.has(name)) return 0.0;
  const FloatInput input = v.float_input(name);
  const double* constant = std::get_if<double>(&input);
  return constant ? FloatInput(std::max(*constant, 0.0)) : input;
}

}  // namespace

std::span<const Spec> hair_specs() {
  return kHair;
}

std::optional<MaterialId> read_hair(Values& v) {
  HairMaterial m;
  m.longitudinal_roughness = std::min(std::max(hair_number(v, "beta_m"), 0.0), 1.0);
  m.azimuthal_roughness = std::min(std::max(hair_number(v, "beta_n"), 0.0), 1.0);
  m.scale_tilt = hair_number(v, "alpha");
  m.eta = hair_number(v, "eta");
  const bool v4 = v.reader().version() == Version::v4;
  const char* color = v4 && v.has("reflectance") ? "reflectance" : "color";
  if (v.has("sigma_a")) {
    m.sigma_a = v.color_input("sigma_a", ColorMeaning::unbounded);
  } else if (v.has(color)) {
    const ColorInput input = v.color_input(color, ColorMeaning::reflectance);
    if (const Spectrum* constant = std::get_if<Spectrum>(&input))
      m.sigma_a = hair_absorption_for(*constant, float(m.azimuthal_roughness));
    else
      m.reflectance = input;
  } else if (v.has("eumelanin") || v.has("pheomelanin")) {
    m.eumelanin = pigment(v, "eumelanin");
    m.pheomelanin = pigment(v, "pheomelanin");
  } else {
    m.eumelanin = 1.3;
    m.pheomelanin = 0.0;
  }
  return v.reader().add_material(m, v.where());
}

}  // namespace duet::pbrt
