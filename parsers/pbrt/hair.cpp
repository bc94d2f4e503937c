// Hair: the same in both versions.
#include <algorithm>
#include <limits>

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

/// Textures are clamped where they are looked up.
FloatInput clamped_input(Values& v, const char* name, double low, double high) {
  const FloatInput input = v.float_input(name);
  const double* constant = std::get_if<double>(&input);
  return constant ? FloatInput(std::clamp(*constant, low, high)) : input;
}

/// The concentration of a pigment.
FloatInput pigment(Values& v, const char* name) {
  if (!v.has(name)) return 0.0;
  return clamped_input(v, name, 0, std::numeric_limits<double>::max());
}

}  // namespace

std::span<const Spec> hair_specs() {
  return kHair;
}

std::optional<MaterialId> read_hair(Values& v) {
  HairMaterial m;
  m.longitudinal_roughness = clamped_input(v, "beta_m", 0, 1);
  m.azimuthal_roughness = clamped_input(v, "beta_n", 0, 1);
  m.scale_tilt = v.float_input("alpha");
  m.eta = v.float_input("eta");
  const bool v4 = v.reader().version() == Version::v4;
  const char* color = v4 && v.has("reflectance") ? "reflectance" : "color";
  if (v.has("sigma_a")) {
    m.sigma_a = v.color_input("sigma_a", ColorMeaning::unbounded);
  } else if (v.has(color)) {
    const ColorInput input = reflectance_input(v, color);
    const Spectrum* constant = std::get_if<Spectrum>(&input);
    const double* roughness = std::get_if<double>(&m.azimuthal_roughness);
    if (constant && roughness)
      m.sigma_a = hair_absorption_for(*constant, float(*roughness));
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
