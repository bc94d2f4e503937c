// Hair: the same in both versions.
#include <algorithm>
#include <cmath>

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

}  // namespace duet::pbrt
