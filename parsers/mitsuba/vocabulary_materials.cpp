#include "mitsuba/readers.h"
#include "mitsuba/vocabulary_tables.h"

namespace duet::vocabulary {

namespace {

// Parameters that several models share.
constexpr Parameter kSpecularReflectance{"specular_reflectance", reflectance, "1",
                                         "scales the reflection; 1 is physical"};
constexpr Parameter kSpecularTransmittance{"specular_transmittance", reflectance, "1",
                                           "scales the refraction; 1 is physical"};
constexpr Parameter kExterior{"ext_ior", ior, "air", "index of refraction outside"};
constexpr Parameter kGlass{"int_ior", ior, "bk7", "index of refraction inside"};
constexpr Parameter kPolymer{"int_ior", ior, "polypropylene", "index of refraction inside"};
constexpr Parameter kDistribution{
    "distribution", string, "beckmann",
    "beckmann or ggx; phong and as of 0.x are approximated by beckmann"};
constexpr Parameter kAlpha{"alpha", number_or_texture, "0.1", "roughness in both directions"};
constexpr Parameter kAlphaU{"alpha_u", number_or_texture, "", "roughness along the tangent"};
constexpr Parameter kAlphaV{"alpha_v", number_or_texture, "", "roughness along the bitangent"};
constexpr Parameter kSampleVisible{"sample_visible", boolean, "true",
                                   "sample only the normals that can be seen"};

constexpr Parameter kDiffuse[] = {{.name = "reflectance",
                                   .type = reflectance,
                                   .preset = "0.5",
                                   .aliases = "diffuse_reflectance"}};

constexpr Parameter kMetal{.name = "material",
                           .type = string,
                           .preset = "none",
                           .note = "name of a metal, or none for a perfect mirror",
                           .preset_0x = "Cu"};
constexpr Parameter kEta{"eta", unbounded, "(of the material)", "real part of the index"};
constexpr Parameter kK{"k", unbounded, "(of the material)", "imaginary part of the index"};
constexpr Parameter kExtEta{.name = "ext_eta",
                            .type = ior,
                            .preset = "air",
                            .note = "index outside, by which eta and k are divided",
                            .versions = v0};
constexpr Parameter kConductor[] = {kMetal, kEta, kK, kExtEta, kSpecularReflectance};
constexpr Parameter kRoughConductor[] = {
    kMetal,        kEta,   kK,      kExtEta, kSpecularReflectance,
    kDistribution, kAlpha, kAlphaU, kAlphaV, kSampleVisible};

constexpr Parameter kDielectric[] = {kGlass, kExterior, kSpecularReflectance,
                                     kSpecularTransmittance};
constexpr Parameter kRoughDielectric[] = {
    kGlass,  kExterior, kSpecularReflectance, kSpecularTransmittance, kDistribution, kAlpha,
    kAlphaU, kAlphaV,   kSampleVisible};

constexpr Parameter kDiffuseBase{"diffuse_reflectance", reflectance, "0.5",
                                 "of the base under the coating"};
constexpr Parameter kNonlinear{"nonlinear", boolean, "false",
                               "colour shifts by scattering inside the coating"};
constexpr Parameter kPlastic[] = {kPolymer, kExterior, kDiffuseBase, kSpecularReflectance,
                                  kNonlinear};
constexpr Parameter kRoughPlastic[] = {
    kPolymer,   kExterior,     kDiffuseBase, kSpecularReflectance,
    kNonlinear, kDistribution, kAlpha,       kSampleVisible};

constexpr Parameter kPrincipled[] = {
    {"base_color", reflectance, "0.5"},
    {"roughness", number_or_texture, "0.5"},
    {"anisotropic", number_or_texture, "0"},
    {"metallic", number_or_texture, "0"},
    {"spec_trans", number_or_texture, "0"},
    {"eta", number, "", "index of refraction; either this or specular", positive},
    {"specular", number, "0.5", "reflection at normal incidence, as Burley scales it"},
    {"spec_tint", number_or_texture, "0"},
    {"sheen", number_or_texture, "0"},
    {"sheen_tint", number_or_texture, "0"},
    {"flatness", number_or_texture, "0"},
    {"clearcoat", number_or_texture, "0"},
    {"clearcoat_gloss", number_or_texture, "0"},
    {"diffuse_reflectance_sampling_rate", number, "1", "", not_negative},
    {"main_specular_sampling_rate", number, "1", "", not_negative},
    {"clearcoat_sampling_rate", number, "1", "", not_negative},
};
constexpr Parameter kPrincipledThin[] = {
    {"base_color", reflectance, "0.5"},
    {"roughness", number_or_texture, "0.5"},
    {"anisotropic", number_or_texture, "0"},
    {"spec_trans", number_or_texture, "0"},
    {"eta", number_or_texture, "1.5"},
    {"spec_tint", number_or_texture, "0"},
    {"sheen", number_or_texture, "0"},
    {"sheen_tint", number_or_texture, "0"},
    {"flatness", number_or_texture, "0"},
    {"diff_trans", number_or_texture, "0", "from 0 (reflection) to 2 (transmission)"},
    {"specular_reflectance_sampling_rate", number, "1", "", not_negative},
    {"specular_transmittance_sampling_rate", number, "1", "", not_negative},
    {"diffuse_reflectance_sampling_rate", number, "1", "", not_negative},
    {"diffuse_transmittance_sampling_rate", number, "1", "", not_negative},
};

constexpr Parameter kDimSpecular{"specular_reflectance", reflectance, "0.2", "of the glossy lobe"};
constexpr Parameter kGlossyBase{"diffuse_reflectance", reflectance, "0.5", "of the diffuse lobe"};
constexpr Parameter kPhong[] = {{"exponent", number_or_texture, "30"}, kDimSpecular, kGlossyBase};
constexpr Parameter kWard[] = {{"variant", string, "balanced", "ward, ward-duer or balanced"},
                               {"alpha_u", number_or_texture, "0.1", "along the tangent"},
                               {"alpha_v", number_or_texture, "0.1", "along the bitangent"},
                               kDimSpecular,
                               kGlossyBase};
constexpr Parameter kRoughDiffuse[] = {
    {"reflectance", reflectance, "0.5"},
    {"alpha", number_or_texture, "0.2", "roughness as that of a Beckmann distribution"},
    {"use_fast_approx", boolean, "false", "without interreflection"}};
constexpr Parameter kDiffuseTransmitter[] = {{"transmittance", reflectance, "0.5"}};
constexpr Parameter kMixture[] = {{"weights", string, "", "numbers, separated by commas"}};

constexpr Parameter kTwoSided[] = {{.name = "allow_transmission",
                                    .type = boolean,
                                    .preset = "false",
                                    .versions = v3,
                                    .support = planned}};
constexpr Parameter kMask[] = {{"opacity", number_or_texture, "0.5"}};
constexpr Parameter kBlend[] = {
    {"weight", number_or_texture, "0.5", "share of the second material, from 0 to 1"}};

constexpr Parameter kBumpMap[] = {
    {.name = "scale",
     .type = number,
     .preset = "1",
     .note = "multiplies the height",
     .versions = v3},
    {.name = "flip_invalid_normals", .type = boolean, .preset = "true", .versions = v3},
    {.name = "use_shadowing_function",
     .type = boolean,
     .preset = "true",
     .versions = v3,
     .preset_0x = "false"}};
constexpr Parameter kNormalMap[] = {
    {.name = "normalmap", .type = texture, .note = "may be nameless in 0.x"},
    {.name = "flip_invalid_normals",
     .type = boolean,
     .preset = "true",
     .versions = v3,
     .preset_0x = "false"},
    {.name = "use_shadowing_function",
     .type = boolean,
     .preset = "true",
     .versions = v3,
     .preset_0x = "false"}};

constexpr Plugin kBsdfs[] = {
    {"diffuse", both, kDiffuse, &read_diffuse},
    {"conductor", both, kConductor, &read_conductor},
    {"roughconductor", both, kRoughConductor, &read_conductor},
    {"dielectric", both, kDielectric, &read_dielectric},
    {"roughdielectric", both, kRoughDielectric, &read_dielectric},
    {"thindielectric", both, kDielectric, &read_thindielectric},
    {"plastic", both, kPlastic, &read_plastic},
    {"roughplastic", both, kRoughPlastic, &read_plastic},
    {"principled", v3, kPrincipled, &read_principled},
    {"principledthin", v3, kPrincipledThin, &read_principledthin},
    {"twosided", both, kTwoSided, &read_twosided, "holds one or two BSDFs"},
    {"mask", both, kMask, &read_mask, "holds a BSDF"},
    {"blendbsdf", both, kBlend, &read_blendbsdf, "holds two BSDFs"},
    {.name = "bumpmap",
     .parameters = kBumpMap,
     .reader = &read_bumpmap,
     .note = "holds a texture and a BSDF",
     .aliases = "bump"},
    {"normalmap", both, kNormalMap, &read_normalmap, "holds a BSDF"},
    {"null", both, {}, &read_null},
    {"phong", both, kPhong, &read_phong, "Mitsuba 3 has none"},
    {"ward", both, kWard, &read_ward, "Mitsuba 3 has none"},
    {"roughdiffuse", both, kRoughDiffuse, &read_roughdiffuse, "Mitsuba 3 has none"},
    {"difftrans", both, kDiffuseTransmitter, &read_difftrans, "Mitsuba 3 has none"},
    {"mixturebsdf", both, kMixture, &read_mixturebsdf, "holds BSDFs; Mitsuba 3 has none"},
    planned_plugin("circular", v3, "transmittance left_handed"),
    planned_plugin("coating", v0, "int_ior ext_ior thickness sigma_a specular_reflectance"),
    planned_plugin("hair", v3,
                   "longitudinal_roughness azimuthal_roughness scale_tilt int_ior ext_ior "
                   "sigma_a eumelanin pheomelanin"),
    planned_plugin("hk", v0, "material sigma_s sigma_a sigma_t albedo thickness"),
    planned_plugin("irawan", v0, "filename repeat_u repeat_v ks_multiplier kd_multiplier"),
    planned_plugin("measured", v3, "filename"),
    {.name = "measured_polarized",
     .versions = v3,
     .note = "light has no polarisation here",
     .support = refused,
     .planned_parameters = "filename alpha_sample wavelength"},
    planned_plugin("polarizer", v3, "theta transmittance polarizing"),
    planned_plugin("pplastic", v3,
                   "diffuse_reflectance specular_reflectance int_ior ext_ior distribution "
                   "alpha alpha_u alpha_v sample_visible"),
    planned_plugin("retarder", v3, "theta delta transmittance"),
    planned_plugin("roughcoating", v0,
                   "int_ior ext_ior thickness sigma_a specular_reflectance distribution "
                   "alpha sample_visible"),
    planned_plugin("sssbrdf", v0, "material sigma_s sigma_a sigma_t albedo int_ior ext_ior alpha"),
};

}  // namespace

std::span<const Plugin> bsdfs() {
  return kBsdfs;
}

}  // namespace duet::vocabulary
