#include "mitsuba/readers.h"
#include "mitsuba/vocabulary_tables.h"

namespace duet::vocabulary {

namespace {

constexpr Parameter kToWorld{"to_world", transform};
constexpr Parameter kScale{"scale", number, "1", "multiplies the light", not_negative};
constexpr Parameter kIntensity{"intensity", emission, "1", "radiant intensity, W/sr"};
constexpr Parameter kRadiance{
    .name = "radiance", .type = emission, .preset = "1", .aliases = "intensity"};

constexpr Parameter kArea[] = {kRadiance};
constexpr Parameter kPoint[] = {
    kIntensity, {"position", point, "0 0 0", "either this or to_world"}, kToWorld};
constexpr Parameter kSpot[] = {
    kIntensity,
    {"cutoff_angle", number, "20", "no light beyond this angle from the axis", degrees},
    {"beam_width", number, "(3/4 cutoff_angle)", "full intensity within this angle", not_negative},
    {"texture", texture, "", "multiplies the intensity"},
    kToWorld};
constexpr Parameter kProjector[] = {
    {"irradiance", emission, "1"},
    kScale,
    {"fov", number, "", "either this or focal_length", degrees},
    {"fov_axis", string, "x", "x, y, diagonal, smaller or larger"},
    {"focal_length", string, "50mm", "of a lens before 36 mm × 24 mm film"},
    kToWorld};
constexpr Parameter kDirectional[] = {
    {"irradiance", emission, "1"},
    {"direction", point, "", "either this or to_world, whose +z it is"},
    kToWorld};
constexpr Parameter kConstant[] = {kRadiance,
                                   {.name = "to_world", .type = transform, .support = inert}};
constexpr Parameter kEnvmap[] = {
    {.name = "filename", .type = file, .required = true},
    {.name = "scale",
     .type = number,
     .preset = "1",
     .range = not_negative,
     .aliases = "intensity_scale"},
    kToWorld,
    {.name = "gamma",
     .type = number,
     .preset = "(of the file)",
     .note = "1: linear, -1: sRGB",
     .versions = v0},
    {.name = "cache", .type = boolean, .versions = v0, .support = inert},
    {.name = "mis_compensation", .type = boolean, .versions = v3, .support = inert}};

constexpr Plugin kEmitters[] = {
    {"area", both, kArea, &read_area, "stands in a shape"},
    {"point", both, kPoint, &read_point},
    {"spot", both, kSpot, &read_spot},
    {"projector", v3, kProjector, &read_projector},
    {"directional", both, kDirectional, &read_directional},
    {"constant", both, kConstant, &read_constant},
    {"envmap", both, kEnvmap, &read_envmap},
    planned_plugin("collimated", v0, "power to_world"),
    planned_plugin("directionalarea", v3, "radiance to_world"),
    planned_plugin("sky", v0,
                   "turbidity albedo year month day hour minute second latitude longitude "
                   "timezone sun_direction stretch resolution scale to_world extend"),
    planned_plugin("sun", v0,
                   "turbidity year month day hour minute second latitude longitude "
                   "timezone sun_direction resolution scale sun_radius_scale to_world"),
    planned_plugin("sunsky", both,
                   "turbidity albedo year month day hour minute second latitude longitude "
                   "timezone sun_direction stretch resolution scale sun_scale sky_scale "
                   "sun_radius_scale sun_aperture complex_sun to_world extend"),
    planned_plugin(
        "timed_sunsky", v3,
        "turbidity albedo start_year start_month start_day end_year end_month end_day "
        "window_start_time window_end_time latitude longitude timezone sun_scale sky_scale "
        "sun_aperture complex_sun shutter_open shutter_close to_world"),
    planned_plugin("volumelight", v3, "radiance to_world"),
};

}  // namespace

std::span<const Plugin> emitters() {
  return kEmitters;
}

}  // namespace duet::vocabulary
