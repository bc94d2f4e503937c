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

constexpr Parameter kHair[] = {
    {"longitudinal_roughness", number, "0.3", "", fraction},
    {"azimuthal_roughness", number, "0.3", "", fraction},
    {"scale_tilt", number, "2", "angle of the scales in degrees"},
    {"int_ior", ior, "amber", "index of refraction inside"},
    kExterior,
    {"eumelanin", number, "1.3", "concentration", not_negative},
    {"pheomelanin", number, "0.2", "concentration", not_negative},
    {"sigma_a", unbounded, "", "absorption per radius, instead of pigments"},
    {"scale", number, "1", "multiplies sigma_a", not_negative}};
constexpr const char* kNormalised = "Mitsuba 0.6 refuses it, too: highlights are normalised";
constexpr Parameter kCloth[] = {
    {.name = "filename", .type = file, .note = "a .wv file", .required = true},
    {.name = "repeat_u", .type = number, .note = "threads are not simulated", .support = inert},
    {.name = "repeat_v", .type = number, .note = "threads are not simulated", .support = inert},
    {.name = "ks_multiplier", .type = number, .note = kNormalised, .support = refused},
    {.name = "kd_multiplier", .type = number, .note = kNormalised, .support = refused}};
constexpr Parameter kMeasured[] = {
    {.name = "filename", .type = file, .note = "a .bsdf file in RGB", .required = true}};
constexpr Parameter kPolarizedPlastic[] = {
    kPolymer, kExterior, kDiffuseBase, kSpecularReflectance, kDistribution,
    kAlpha,   kAlphaU,   kAlphaV,      kSampleVisible};

/// Of filters whose effect on polarisation is not seen.
constexpr const char* kUnpolarized = "for light without polarisation, with a warning";
constexpr Parameter kFilterTransmittance{"transmittance", reflectance, "1"};
constexpr Parameter kTheta{.name = "theta", .type = number_or_texture, .support = inert};
constexpr Parameter kPolarizer[] = {
    kFilterTransmittance,
    kTheta,
    {.name = "polarizing", .type = boolean, .note = "either way half passes", .support = inert}};
constexpr Parameter kRetarder[] = {
    kFilterTransmittance, kTheta, {.name = "delta", .type = number_or_texture, .support = inert}};
constexpr Parameter kCircular[] = {
    kFilterTransmittance, kTheta, {.name = "left_handed", .type = boolean, .support = inert}};

constexpr Parameter kThickness{"thickness", number, "1", "of the layer", not_negative};
constexpr Parameter kCoatAbsorption{"sigma_a", unbounded, "0", "absorption per thickness"};
constexpr Parameter kCoating[] = {kGlass, kExterior, kThickness, kCoatAbsorption,
                                  kSpecularReflectance};
constexpr Parameter kRoughCoating[] = {
    kGlass,        kExterior, kThickness,    kCoatAbsorption, kSpecularReflectance,
    kDistribution, kAlpha,    kSampleVisible};
constexpr Parameter kMediumName{"material", string, "skin1", "name of a medium"};
constexpr Parameter kScattering{"sigma_s", unbounded, "", "scattering coefficient"};
constexpr Parameter kAbsorption{"sigma_a", unbounded, "", "absorption coefficient"};
constexpr Parameter kExtinction{"sigma_t", unbounded, "", "extinction coefficient"};
constexpr Parameter kAlbedo{"albedo", reflectance, "", "share that is scattered"};
constexpr Parameter kThinLayer[] = {kMediumName, kScattering, kAbsorption,
                                    kExtinction, kAlbedo,     kThickness};
constexpr Parameter kSubsurface[] = {
    kMediumName,   kScattering, kAbsorption,    kExtinction,
    kAlbedo,       kGlass,      kExterior,      {"g", number, "0", "mean cosine of scattering"},
    kDistribution, kAlpha,      kSampleVisible,
};

constexpr Parameter kTwoSided[] = {{.name = "allow_transmission",
                                    .type = boolean,
                                    .preset = "false",
                                    .note = "a BSDF that lets light through is refused",
                                    .versions = v3}};
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
    {.name = "normalmap", .type = reflectance, .note = "(n + 1) / 2; may be nameless in 0.x"},
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
    {"blendbsdf", both, kBlend, &read_blendbsdf, "holds two BSDFs; see `blend-delta` below"},
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
    {"circular", v3, kCircular, &read_filter_of_light, kUnpolarized},
    {"coating", both, kCoating, &read_coating, "holds a BSDF; Mitsuba 3 has none"},
    {"hair", v3, kHair, &read_hair_material, "for bsplinecurve"},
    {.name = "hk",
     .parameters = kThinLayer,
     .reader = &read_hk,
     .note = "may hold a phase function: isotropic or hg; Mitsuba 3 has none"},
    {"irawan", v0, kCloth, &read_irawan,
     "woven cloth is its average colours and a wide highlight; the file's own parameters are "
     "colours; Mitsuba 3 has none",
     approximated},
    {"measured", v3, kMeasured, &read_measured_material, "files in RGB"},
    {.name = "measured_polarized",
     .versions = v3,
     .note = "light has no polarisation here",
     .support = refused,
     .refused_parameters = "filename alpha_sample wavelength"},
    {"polarizer", v3, kPolarizer, &read_filter_of_light, kUnpolarized},
    {"pplastic", v3, kPolarizedPlastic, &read_pplastic,
     "as Mitsuba's variants without polarisation"},
    {"retarder", v3, kRetarder, &read_filter_of_light, kUnpolarized},
    {"roughcoating", both, kRoughCoating, &read_coating, "holds a BSDF; Mitsuba 3 has none"},
    {.name = "sssbrdf",
     .parameters = kSubsurface,
     .reader = &read_sssbrdf,
     .note = "a rough plastic with the reflectance of a dipole; Mitsuba 3 has none",
     .support = approximated},
};

}  // namespace

std::span<const Plugin> bsdfs() {
  return kBsdfs;
}

}  // namespace duet::vocabulary
