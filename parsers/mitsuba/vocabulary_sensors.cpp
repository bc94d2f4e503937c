#include "mitsuba/readers.h"
#include "mitsuba/vocabulary_tables.h"

namespace duet::vocabulary {

namespace {

constexpr Parameter kFov{"fov", number, "", "in degrees; either this or focal_length", degrees};
constexpr Parameter kFovAxis{"fov_axis", string, "x", "x, y, diagonal, smaller or larger"};
constexpr Parameter kFocalLength{"focal_length", string, "50mm",
                                 "of a lens before 36 mm × 24 mm film"};
constexpr Parameter kResponse{.name = "srf",
                              .type = texture,
                              .note = "light is computed as red, green and blue, not by wavelength",
                              .versions = v3,
                              .support = refused};

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

constexpr Parameter kMeter[] = {kResponse};
constexpr Parameter kRadianceMeter[] = {
    {.name = "origin",
     .type = point,
     .note = "with direction, instead of to_world",
     .versions = v3},
    {.name = "direction", .type = point, .note = "of the ray", .versions = v3},
    kResponse};
constexpr Parameter kDistant[] = {
    {"direction", point, "", "of the rays; either this or to_world, whose +z it is"},
    {"target", point, "(the scene)", "a point or a shape over which radiance is averaged"},
    kResponse};
constexpr Parameter kTelecentric[] = {
    {"aperture_radius", number, "0", "", not_negative},
    {"focus_distance", number, "(far_clip)", "along the axis", positive}};
constexpr Parameter kRdist[] = {
    kFov,
    kFovAxis,
    kFocalLength,
    {"kc", string, "0, 0", "radial distortion of third and fifth order"},
    {.name = "focus_distance", .type = number, .support = inert}};

const Plugin kSensors[] = {
    {"perspective", both, kPerspective, &read_perspective},
    {"thinlens", both, kThinlens, &read_thinlens},
    {"orthographic", both, kOrthographic, &read_orthographic},
    {"radiancemeter", both, kRadianceMeter, &read_radiancemeter, "one pixel"},
    {"irradiancemeter", both, kMeter, &read_irradiancemeter, "stands in a shape"},
    {"distant", v3, kDistant, &read_distant, "one pixel"},
    {"batch", v3, kMeter, &read_batch, "holds sensors, side by side on its film"},
    {"fluencemeter", v0, {}, &read_fluencemeter, "one pixel"},
    {"spherical", v0, {}, &read_spherical},
    {"telecentric", v0, kTelecentric, &read_telecentric},
    {"perspective_rdist", v0, kRdist, &read_perspective_rdist},
};

constexpr Parameter kHdrfilm[] = {
    {"pixel_format", string, "rgb", "luminance, luminance_alpha, rgb, rgba, xyz, xyza"},
    {"component_format", string, "float16", "float16 or float32; uint32 becomes float32"},
    {.name = "file_format", .type = string, .preset = "openexr", .support = ignored},
    {.name = "channel_names",
     .type = string,
     .note = "layers keep the names of their fields",
     .versions = v0,
     .support = ignored},
};
constexpr Parameter kMfilm[] = {
    {"pixel_format", string, "luminance", "luminance, luminance_alpha, rgb, rgba, xyz, xyza"},
    {.name = "file_format", .type = string, .support = inert},
    {.name = "digits", .type = integer, .support = inert},
    {.name = "variable", .type = string, .support = inert},
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

const Plugin kFilms[] = {
    {"hdrfilm", both, kHdrfilm, &read_hdrfilm},
    {"ldrfilm", v0, kLdrfilm, &read_ldrfilm, "tone mapping is for PNG and JPEG output"},
    {"tiledhdrfilm", v0, kHdrfilm, &read_hdrfilm, "written as any other EXR file"},
    {"mfilm", v0, kMfilm, &read_mfilm, "written as EXR; 1 x 1 pixels unless the file says so",
     approximated},
    {.name = "specfilm",
     .versions = v3,
     .note = "light is computed as red, green and blue, not by wavelength",
     .support = refused,
     .refused_parameters = "component_format"},
};

constexpr Parameter kBox[] = {
    {.name = "radius", .type = number, .preset = "0.5", .range = positive, .versions = v0}};
constexpr Parameter kTent[] = {{"radius", number, "1", "", positive}};
constexpr Parameter kGaussian[] = {{"stddev", number, "0.5", "", positive}};
constexpr Parameter kMitchell[] = {
    {.name = "B", .type = number, .preset = "(1/3)", .aliases = "b"},
    {.name = "C", .type = number, .preset = "(1/3)", .aliases = "c"}};
constexpr Parameter kLanczos[] = {{"lobes", integer, "3", "", positive}};

const Plugin kFilters[] = {
    {"box", both, kBox, &read_filter},           {"tent", both, kTent, &read_filter},
    {"gaussian", both, kGaussian, &read_filter}, {"mitchell", both, kMitchell, &read_filter},
    {"catmullrom", both, {}, &read_filter},      {"lanczos", both, kLanczos, &read_filter},
};

/// A sampler whose place Duet's own takes.
Plugin sobol_instead(std::string_view name, FileVersions versions) {
  return {.name = name,
          .versions = versions,
          .reader = &read_sampler,
          .note = "Owen-scrambled Sobol' points instead",
          .support = Support::approximated};
}

const Plugin kSamplers[] = {
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
