#include "mitsuba/readers.h"
#include "mitsuba/vocabulary_tables.h"

namespace duet::vocabulary {

namespace {

constexpr Parameter kFov{"fov", number, "", "in degrees; either this or focal_length", degrees};
constexpr Parameter kFovAxis{"fov_axis", string, "x", "x, y, diagonal, smaller or larger"};
constexpr Parameter kFocalLength{"focal_length", string, "50mm",
                                 "of a lens before 36 mm × 24 mm film"};
constexpr Parameter kResponse{.name = "srf", .type = texture, .versions = v3, .support = planned};

constexpr Parameter kPerspective[] = {kFov,
                                      kFovAxis,
                                      kFocalLength,
                                      {"principal_point_offset_x", number, "0", "in image widths"},
                                      {"principal_point_offset_y", number, "0", "in image heights"},
                                      {.name = "focus_distance", .type = number, .support = inert},
                                      kResponse};
constexpr Parameter kThinlens[] = {
    kFov,
    kFovAxis,
    kFocalLength,
    {.name = "aperture_radius", .type = number, .range = not_negative, .required = true},
    {"focus_distance", number, "(far_clip)", "along the axis", positive},
    kResponse};
constexpr Parameter kOrthographic[] = {{.name = "focus_distance", .type = number, .support = inert},
                                       kResponse};

constexpr Plugin kSensors[] = {
    {"perspective", both, kPerspective, &read_perspective},
    {"thinlens", both, kThinlens, &read_thinlens},
    {"orthographic", both, kOrthographic, &read_orthographic},
    planned_plugin("batch", v3),
    planned_plugin("distant", v3, "direction target to_world"),
    planned_plugin("fluencemeter", v0, "to_world"),
    planned_plugin("irradiancemeter", both),
    planned_plugin("perspective_rdist", v0,
                   "kc fov fov_axis focal_length near_clip far_clip to_world"),
    planned_plugin("radiancemeter", both, "origin direction to_world"),
    planned_plugin("spherical", v0, "to_world"),
    planned_plugin("telecentric", v0, "aperture_radius focus_distance near_clip far_clip to_world"),
};

constexpr Parameter kHdrfilm[] = {
    {"pixel_format", string, "rgb", "luminance, luminance_alpha, rgb, rgba, xyz, xyza"},
    {"component_format", string, "float16", "float16 or float32"},
    {.name = "file_format", .type = string, .preset = "openexr", .support = ignored},
    {.name = "channel_names", .type = string, .versions = v0, .support = planned},
};
constexpr Parameter kLdrfilm[] = {
    {"pixel_format", string, "rgb", "luminance, luminance_alpha, rgb, rgba"},
    {.name = "file_format", .type = string, .support = inert},
    {.name = "tonemap_method", .type = string, .preset = "gamma", .note = "gamma or reinhard"},
    {"gamma", number, "-1", "-1: sRGB"},
    {"exposure", number, "0", "in stops"},
    {"key", number, "0.18", "of Reinhard's operator", positive},
    {"burn", number, "0", "of Reinhard's operator, from 0 to 1", not_negative},
};

constexpr Plugin kFilms[] = {
    {"hdrfilm", both, kHdrfilm, &read_hdrfilm},
    {"ldrfilm", v0, kLdrfilm, &read_ldrfilm, "tone mapping is for PNG and JPEG output"},
    planned_plugin("mfilm", v0,
                   "width height crop_offset_x crop_offset_y crop_width crop_height "
                   "file_format digits variable pixel_format high_quality_edges"),
    {.name = "specfilm",
     .versions = v3,
     .note = "light is computed as red, green and blue, not by wavelength",
     .support = refused,
     .planned_parameters = "component_format"},
    planned_plugin("tiledhdrfilm", v0,
                   "width height crop_offset_x crop_offset_y crop_width crop_height "
                   "pixel_format component_format"),
};

constexpr Parameter kBox[] = {
    {.name = "radius", .type = number, .preset = "0.5", .range = positive, .versions = v0}};
constexpr Parameter kTent[] = {{"radius", number, "1", "", positive}};
constexpr Parameter kGaussian[] = {{"stddev", number, "0.5", "", positive}};
constexpr Parameter kMitchell[] = {
    {.name = "B", .type = number, .preset = "(1/3)", .aliases = "b"},
    {.name = "C", .type = number, .preset = "(1/3)", .aliases = "c"}};
constexpr Parameter kLanczos[] = {{"lobes", integer, "3", "", positive}};

constexpr Plugin kFilters[] = {
    {"box", both, kBox, &read_filter},           {"tent", both, kTent, &read_filter},
    {"gaussian", both, kGaussian, &read_filter}, {"mitchell", both, kMitchell, &read_filter},
    {"catmullrom", both, {}, &read_filter},      {"lanczos", both, kLanczos, &read_filter},
};

/// A sampler whose place Duet's own takes.
constexpr Plugin sobol_instead(std::string_view name, FileVersions versions) {
  return {.name = name,
          .versions = versions,
          .reader = &read_sampler,
          .note = "Owen-scrambled Sobol' points instead",
          .support = Support::approximated};
}

constexpr Plugin kSamplers[] = {
    {"independent",
     both,
     {},
     &read_sampler,
     "Owen-scrambled Sobol' points, with --strict-sampler independent ones"},
    sobol_instead("stratified", both),
    sobol_instead("multijitter", v3),
    sobol_instead("orthogonal", v3),
    sobol_instead("ldsampler", both),
    {"sobol", v0, {}, &read_sampler, "Owen-scrambled"},
    sobol_instead("halton", v0),
    sobol_instead("hammersley", v0),
};

}  // namespace

std::span<const Plugin> sensors() {
  return kSensors;
}
std::span<const Plugin> films() {
  return kFilms;
}
std::span<const Plugin> rfilters() {
  return kFilters;
}
std::span<const Plugin> samplers() {
  return kSamplers;
}

}  // namespace duet::vocabulary
