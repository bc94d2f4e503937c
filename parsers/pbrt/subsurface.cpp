// The media of materials in which light is scattered beneath the surface.
#include <cmath>

#include "pbrt/materials.h"
#include "values/half_space.h"
#include "values/medium_presets.h"

namespace duet::pbrt {

namespace {

/// A colour where a texture is not possible.
std::optional<Spectrum> constant(Values& v, const char* name, ColorMeaning meaning) {
  const ColorInput input = v.color_input(name, meaning);
  if (const Spectrum* c = std::get_if<Spectrum>(&input)) return *c;
  v.reader().report().error(v.where(name), "textures of \"{}\" are not supported", name);
  return std::nullopt;
}

}  // namespace

std::optional<MediumDescription> read_subsurface_medium(Values& v, double eta) {
  Reader& reader = v.reader();
  const double g = v.number("g"), scale = v.not_negative("scale");
  Spectrum extinction, albedo;
  if (v.has("reflectance")) {
    const auto reflectance = constant(v, "reflectance", ColorMeaning::reflectance),
               path = constant(v, "mfp", ColorMeaning::unbounded);
    if (!reflectance || !path) return std::nullopt;
    for (int c = 0; c < 3; ++c) {
      albedo[c] = float(half_space_albedo(double((*reflectance)[c]), g, eta));
      extinction[c] = 1 / std::max((*path)[c], 1e-6f);
    }
  } else {
    auto absorption = constant(v, "sigma_a", ColorMeaning::unbounded),
         scattering = constant(v, "sigma_s", ColorMeaning::unbounded);
    if (!absorption || !scattering) return std::nullopt;
    if (v.has("name")) {
      const std::string name = v.string("name");
      const MediumPreset* preset = find_medium_preset(name);
      if (!preset) {
        reader.report().error(v.where("name"), "there is no medium {}{}", in_quotes(name),
                              did_you_mean(name, medium_preset_names()));
        return std::nullopt;
      }
      absorption = preset->sigma_a, scattering = preset->sigma_s;
    }
    for (int c = 0; c < 3; ++c) {
      extinction[c] = ((*absorption)[c] + (*scattering)[c]) * float(scale);
      albedo[c] = extinction[c] > 0 ? (*scattering)[c] * float(scale) / extinction[c] : 0.0f;
    }
  }
  SceneDescription& scene = reader.scene();
  PhaseDescription phase;
  phase.where = v.where();
  if (g == 0)
    phase.model = IsotropicPhase{};
  else
    phase.model = HenyeyGreensteinPhase{g};
  scene.phases.push_back(std::move(phase));
  MediumDescription medium;
  medium.where = v.where();
  medium.sigma_t = extinction;
  medium.albedo = albedo;
  medium.phase = PhaseId(scene.phases.size() - 1);
  return medium;
}

}  // namespace duet::pbrt
