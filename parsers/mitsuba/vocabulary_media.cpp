#include "mitsuba/readers.h"
#include "mitsuba/vocabulary_tables.h"

namespace duet::vocabulary {

namespace {

constexpr Parameter kMediumScale{.name = "scale",
                                 .type = number,
                                 .preset = "1",
                                 .note = "multiplies the extinction",
                                 .range = not_negative,
                                 .aliases = "density_multiplier size_multiplier"};
/// How light is sampled, which does not change what it does.
constexpr Parameter kSampleEmitters{
    .name = "sample_emitters", .type = boolean, .versions = v3, .support = inert};
constexpr Parameter kSpectralExtinction{
    .name = "has_spectral_extinction", .type = boolean, .versions = v3, .support = inert};

constexpr Parameter kHomogeneous[] = {
    {.name = "sigma_t",
     .type = coefficient,
     .preset = "1",
     .note = "extinction per unit of length",
     .preset_0x = "(of the material)"},
    {.name = "albedo",
     .type = albedo,
     .preset = "0.75",
     .note = "share of it that is scattered",
     .preset_0x = "(of the material)"},
    {.name = "sigma_a",
     .type = coefficient,
     .preset = "(of the material)",
     .note = "absorption; with sigma_s instead of sigma_t and albedo",
     .versions = v0},
    {.name = "sigma_s",
     .type = coefficient,
     .preset = "(of the material)",
     .note = "scattering",
     .versions = v0},
    {.name = "material",
     .type = string,
     .preset = "skin1",
     .note = "coefficients by the name of a material",
     .versions = v0},
    {.name = "g",
     .type = coefficient,
     .preset = "(of the material)",
     .note = "scattering counts 1 - g times",
     .versions = v0},
    kMediumScale,
    kSampleEmitters,
    kSpectralExtinction,
    {.name = "strategy",
     .type = string,
     .preset = "balance",
     .note = "balance, single, maximum or manual; matters to monochromatic only",
     .versions = v0},
    {.name = "channel",
     .type = integer,
     .preset = "(of least extinction)",
     .note = "0 to 2; matters to monochromatic only",
     .versions = v0},
    {.name = "monochromatic",
     .type = boolean,
     .preset = "false",
     .note = "with strategy single: all channels are like the one chosen",
     .versions = v0},
    {.name = "sampling_density", .type = number, .versions = v0, .support = inert},
    {.name = "medium_sampling_weight", .type = number, .versions = v0, .support = inert},
};
constexpr Parameter kHeterogeneous[] = {
    {"sigma_t", coefficient, "1", "extinction per unit of length"},
    {.name = "density", .type = coefficient, .note = "the same in 0.x", .versions = v0},
    {"albedo", albedo, "0.75", "share of it that is scattered"},
    {.name = "orientation",
     .type = coefficient,
     .note = "has no effect: phase functions that need it are approximated",
     .versions = v0,
     .support = approximated},
    kMediumScale,
    kSampleEmitters,
    kSpectralExtinction,
    {.name = "method", .type = string, .versions = v0, .support = inert},
    {.name = "step_size", .type = number, .versions = v0, .support = inert},
};

const Plugin kMedia[] = {{"homogeneous", both, kHomogeneous, &read_homogeneous},
                         {"heterogeneous", both, kHeterogeneous, &read_heterogeneous}};

constexpr Parameter kHg[] = {{"g", number, "0.8", "mean cosine of the deflection"}};
constexpr Parameter kBlendphase[] = {
    {"weight", number_or_volume, "0.5", "share of the second phase function"}};
constexpr Parameter kSggx[] = {{.name = "S",
                                .type = volume_only,
                                .note = "6 channels: xx, yy, zz, xy, xz, yz",
                                .required = true}};
constexpr Parameter kTabphase[] = {{.name = "values",
                                    .type = string,
                                    .note = "at equidistant cosines of the deflection from -1 to 1",
                                    .required = true}};
constexpr Parameter kMixturephase[] = {
    {.name = "weights", .type = string, .note = "one for each phase function", .required = true}};
constexpr std::string_view kNoEffect = "has no effect";
constexpr Parameter kKkay[] = {
    {.name = "ks", .type = number, .note = kNoEffect, .versions = v0, .support = approximated},
    {.name = "kd", .type = number, .note = kNoEffect, .versions = v0, .support = approximated},
    {.name = "exponent",
     .type = number,
     .note = kNoEffect,
     .versions = v0,
     .support = approximated}};
constexpr Parameter kMicroflake[] = {
    {.name = "stddev", .type = number, .note = kNoEffect, .versions = v0, .support = approximated}};

const Plugin kPhases[] = {
    {"isotropic", both, {}, &read_isotropic},
    {"hg", both, kHg, &read_hg},
    {"rayleigh", both, {}, &read_rayleigh},
    {"blendphase", v3, kBlendphase, &read_blendphase, "holds two phase functions"},
    {"sggx", v3, kSggx, &read_sggx, "see `sggx-flakes` below"},
    {"tabphase", v3, kTabphase, &read_tabphase},
    {"kkay", v0, kKkay, &read_fibre_phase, "by isotropic", approximated},
    {"microflake", v0, kMicroflake, &read_fibre_phase, "by isotropic", approximated},
    {"mixturephase", v0, kMixturephase, &read_mixturephase, "holds phase functions"},
};

constexpr Parameter kConstvolume[] = {{"value", coefficient, "1"},
                                      {.name = "to_world",
                                       .type = transform,
                                       .note = "places the box that a heterogeneous medium of "
                                               "constant extinction fills in 3.x"}};
constexpr Parameter kGridvolume[] = {
    {.name = "filename", .type = file, .required = true},
    {"to_world", transform},
    {.name = "filter_type",
     .type = string,
     .preset = "trilinear",
     .note = "trilinear or nearest",
     .versions = v3},
    {.name = "wrap_mode",
     .type = string,
     .preset = "clamp",
     .note = "clamp, repeat or mirror",
     .versions = v3},
    {.name = "use_grid_bbox",
     .type = boolean,
     .preset = "false",
     .note = "place the grid in the box of the file; 0.x always does",
     .versions = v3},
    {.name = "min",
     .type = point,
     .preset = "0 0 0",
     .note = "with max: another box than the file's",
     .versions = v0},
    {.name = "max", .type = point, .preset = "1 1 1", .versions = v0},
    {.name = "raw", .type = boolean, .versions = v3, .support = inert},
    {.name = "accel", .type = boolean, .versions = v3, .support = inert},
    {.name = "max_value", .type = number, .versions = v3, .support = inert},
    {.name = "send_data", .type = boolean, .versions = v0, .support = inert},
};
constexpr Parameter kVolcache[] = {
    {.name = "block_size", .type = integer, .support = inert},
    {.name = "voxel_width", .type = number, .support = inert},
    {.name = "memory_limit", .type = integer, .support = inert, .aliases = "cache_size"},
};

const Plugin kVolumes[] = {
    {"constvolume", both, kConstvolume, &read_constvolume},
    {"gridvolume", both, kGridvolume, &read_gridvolume},
    {.name = "hgridvolume",
     .versions = v0,
     .note = "grids of grids are not read",
     .support = refused,
     .refused_parameters = "filename prefix postfix to_world"},
    {"volcache", v0, kVolcache, &read_volcache, "holds a volume"},
};

const Plugin kSubsurfaces[] = {
    {.name = "dipole",
     .versions = v0,
     .note = "light leaves a surface where it entered: use an interior medium with volpath",
     .support = refused,
     .refused_parameters =
         "material sigma_s sigma_a sigma_t albedo int_ior ext_ior scale irr_samples quality"},
    {.name = "singlescatter",
     .versions = v0,
     .note = "light leaves a surface where it entered: use an interior medium with volpath",
     .support = refused,
     .refused_parameters = "fast_single_scatter fast_single_scatter_samples "
                           "single_scatter_shadow_rays single_scatter_transmittance "
                           "single_scatter_depth"},
};

}  // namespace

std::span<const Plugin> media() {
  return kMedia;
}
std::span<const Plugin> phases() {
  return kPhases;
}
std::span<const Plugin> volumes() {
  return kVolumes;
}
std::span<const Plugin> subsurfaces() {
  return kSubsurfaces;
}

}  // namespace duet::vocabulary
