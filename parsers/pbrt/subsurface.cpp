// The media of materials in which light is scattered beneath the surface.
#include <cmath>

#include "pbrt/materials.h"
#include "scene/texture_texels.h"
#include "values/half_space.h"
#include "values/medium_presets.h"

namespace duet::pbrt {

namespace {

// clang-format off
#define DUET_SURFACE_SPECS                                                          \
  {"g", kNumber, "0", "mean cosine of scattering"},                                 \
  {"Kr", kColorTexture, "1", "", 1, Status::done, Versions::v3},                    \
  {"Kt", kColorTexture, "1", "", 1, Status::done, Versions::v3},                    \
  {"roughness", kNumberTexture, "0", "", 1, Status::done, Versions::v4},            \
  {"uroughness", kNumberTexture, "0"},                                              \
  {"vroughness", kNumberTexture, "0"},                                              \
  {"remaproughness", kBoolean, "true", "as for other materials of the version"}
// clang-format on

constexpr Spec kSubsurface[] = {
    {"sigma_a", kColorTexture, "0.0011 0.0024 0.014", "absorption"},
    {"sigma_s", kColorTexture, "2.55 3.21 3.77", "scattering"},
    {"scale", kNumber, "1", "of both, or of the mean free path"},
    {"reflectance", kColorTexture, "", "of a thick layer, with mfp", 1, Status::done, Versions::v4},
    {"mfp", kColorTexture, "1", "mean free path", 1, Status::done, Versions::v4},
    {"name", kString, "", "of a known medium"},
    {"eta", kIndex, "1.33", "index of refraction"},
    DUET_SURFACE_SPECS};

constexpr Spec kKdSubsurface[] = {{"Kd", kColorTexture, "0.5", "of a thick layer"},
                                  {"mfp", kColorTexture, "1", "mean free path"},
                                  {"scale", kNumber, "1", "of the mean free path"},
                                  {"eta", kIndex, "1.33", "index of refraction"},
                                  DUET_SURFACE_SPECS};

#undef DUET_SURFACE_SPECS

/// The texels of a texture that is an image; nothing, with an error, for any other.
std::optional<TextureTexels> texels_of(Values& v, const char* name, TextureId id) {
  const TextureDescription& t = v.reader().scene().textures[size_t(id)];
  Report& report = v.reader().report();
  if (const auto* image = std::get_if<BitmapTexture>(&t.model))
    return report.from_file(v.where(name), [&] { return read_texels(*image); });
  report.error(v.where(name), "of the textures of \"{}\", only images are supported", name);
  return std::nullopt;
}

/// A colour where a texture is not possible: its mean.
Spectrum constant(Values& v, const char* name, ColorMeaning meaning) {
  const ColorInput input = v.color_input(name, meaning);
  if (const Spectrum* c = std::get_if<Spectrum>(&input)) return *c;
  const auto texels = texels_of(v, name, std::get<TextureId>(input));
  if (!texels) return Spectrum(0.5f);
  v.reader().approximate(v.where(name), fmt::format("a texture of \"{}\" by its mean", name));
  return texels->mean();
}

/// The known medium that is asked for; v3 goes on without one.
const MediumPreset* known_medium(Values& v) {
  if (!v.has("name")) return nullptr;
  const std::string name = v.string("name");
  const MediumPreset* preset = find_medium_preset(name);
  if (preset) return preset;
  const std::string wrong = no_medium_preset(name);
  if (v.reader().version() == Version::v3)
    v.reader().report().warning(v.where("name"), "{}; the coefficients hold, as in pbrt-v3", wrong);
  else
    v.reader().report().error(v.where("name"), "{}", wrong);
  return nullptr;
}

/// A medium and what its free paths and albedo are.
MediumDescription medium_of(Values& v, const Spectrum& extinction, const Spectrum& albedo,
                            double g) {
  SceneDescription& scene = v.reader().scene();
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

/// The share of light that a thick layer gives back, and what differs from place to place.
struct Reflectance {
  Spectrum most;
  std::optional<TextureId> tint;  ///< of what enters and of what leaves
};

/// Where the reflectance is a texture, the medium has the largest one, and the surface takes the
/// square root of the rest away, twice: so every place that is larger than light wanders has its
/// own.
Reflectance read_reflectance(Values& v, const char* name) {
  const ColorInput input = reflectance_input(v, name);
  if (const Spectrum* c = std::get_if<Spectrum>(&input)) return {*c, {}};
  const TextureId id = std::get<TextureId>(input);
  const auto texels = texels_of(v, name, id);
  if (!texels) return {Spectrum(0.5f), {}};
  Spectrum most = texels->largest();
  for (int c = 0; c < 3; ++c) most[c] = std::max(most[c], 0.01f);
  v.reader().approximate(v.where(name),
                         "a texture of the reflectance beneath a surface by a tint of "
                         "what enters and leaves");
  const SourceLocation& where = v.where(name);
  const TextureId share = v.reader().add_texture(
      ScaledTextureDescription{id, Spectrum(1 / most.r, 1 / most.g, 1 / most.b)}, where);
  return {most, v.reader().add_texture(FunctionDescription{share, TextureFunction::root}, where)};
}

/// The medium of which a thick layer has a reflectance; `scale` multiplies its mean free path.
MediumDescription medium_by_reflectance(Values& v, const Spectrum& reflectance, double eta,
                                        double scale) {
  const Spectrum path = constant(v, "mfp", ColorMeaning::unbounded);
  Spectrum extinction, albedo;
  for (int c = 0; c < 3; ++c) {
    albedo[c] = float(half_space_albedo(double(reflectance[c]), v.number("g"), eta));
    extinction[c] = 1 / std::max(float(scale) * path[c], 1e-6f);
  }
  return medium_of(v, extinction, albedo, v.number("g"));
}

MediumDescription medium_by_coefficients(Values& v) {
  const float scale = float(v.not_negative("scale"));
  const MediumPreset* preset = known_medium(v);
  // In v3 coefficients that are given hold beside the name of a medium.
  const auto read = [&](const char* name, const Spectrum MediumPreset::*known) {
    const bool counts = v.reader().version() == Version::v3 && v.has(name);
    return preset && !counts ? preset->*known : constant(v, name, ColorMeaning::unbounded);
  };
  const Spectrum absorption = read("sigma_a", &MediumPreset::sigma_a),
                 scattering = read("sigma_s", &MediumPreset::sigma_s);
  Spectrum albedo;
  const Spectrum extinction = (absorption + scattering) * scale;
  for (int c = 0; c < 3; ++c)
    albedo[c] = extinction[c] > 0 ? scattering[c] * scale / extinction[c] : 0.0f;
  // Known media scatter the same in all directions, whatever "g" says.
  return medium_of(v, extinction, albedo, preset ? 0.0 : v.number("g"));
}

/// The surface with the medium behind it.
MaterialId bounded(Values& v, MediumDescription medium, double eta,
                   const std::optional<TextureId>& tint = {}) {
  DielectricMaterial m;
  m.eta = eta;
  const bool v3 = v.reader().version() == Version::v3;
  if (v3) {
    m.specular_reflectance = v.color_input("Kr", ColorMeaning::reflectance);
    m.specular_transmittance = v.color_input("Kt", ColorMeaning::reflectance);
  }
  if (tint) m.specular_transmittance = *tint;
  m.roughness = v3 ? read_glass_roughness(v, "uroughness") : read_roughness(v);
  const MaterialId id = v.reader().add_material(m, v.where());
  v.reader().set_interior(id, std::move(medium));
  return id;
}

}  // namespace

std::span<const Spec> subsurface_specs() {
  return kSubsurface;
}

std::span<const Spec> kd_subsurface_specs() {
  return kKdSubsurface;
}

std::optional<MaterialId> read_subsurface(Values& v) {
  const double eta = v.index_of_refraction("eta");
  if (v.reader().version() == Version::v4 && v.has("reflectance")) {
    const Reflectance r = read_reflectance(v, "reflectance");
    return bounded(v, medium_by_reflectance(v, r.most, eta, v.positive("scale")), eta, r.tint);
  }
  return bounded(v, medium_by_coefficients(v), eta);
}

std::optional<MaterialId> read_kd_subsurface(Values& v) {
  const double eta = v.index_of_refraction("eta");
  const Reflectance r = read_reflectance(v, "Kd");
  return bounded(v, medium_by_reflectance(v, r.most, eta, v.positive("scale")), eta, r.tint);
}

}  // namespace duet::pbrt
