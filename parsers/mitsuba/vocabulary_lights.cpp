#include "mitsuba/readers.h"
#include "mitsuba/vocabulary_tables.h"

namespace duet::vocabulary {

namespace {

constexpr Parameter kToWorld{"to_world", transform}, kPlace{"to_world", transform, "", kMovable};
constexpr Parameter kLightScale{"scale", number, "1", "multiplies the light", not_negative};
constexpr Parameter kIntensity{"intensity", emission, "1", "radiant intensity, W/sr"};
constexpr Parameter kRadiance{
    .name = "radiance", .type = emission, .preset = "1", .aliases = "intensity"};

constexpr Parameter kArea[] = {kRadiance};
constexpr Parameter kPoint[] = {
    kIntensity, {"position", point, "0 0 0", "either this or to_world"}, kPlace};
constexpr Parameter kSpot[] = {
    kIntensity,
    {"cutoff_angle", number, "20", "no light beyond this angle from the axis", degrees},
    {"beam_width", number, "(3/4 cutoff_angle)", "full intensity within this angle", not_negative},
    {"texture", texture, "", "multiplies the intensity"},
    kPlace};
constexpr Parameter kProjector[] = {
    {"irradiance", emission, "1"},
    kLightScale,
    {"fov", number, "", "either this or focal_length", degrees},
    {"fov_axis", string, "x", "x, y, diagonal, smaller or larger"},
    {"focal_length", string, "50mm", "of a lens before 36 mm × 24 mm film"},
    kPlace};
constexpr Parameter kDirectional[] = {
    {"irradiance", emission, "1"},
    {"direction", point, "", "either this or to_world, whose +z it is"},
    kPlace};
constexpr Parameter kConstant[] = {kRadiance,
                                   {.name = "to_world", .type = transform, .support = inert}};
constexpr Parameter kEnvmap[] = {
    {.name = "filename", .type = file, .required = true},
    {.name = "scale",
     .type = number,
     .preset = "1",
     .range = not_negative,
     .aliases = "intensity_scale"},
    kPlace,
    {.name = "gamma",
     .type = number,
     .preset = "(of the file)",
     .note = "1: linear, -1: sRGB",
     .versions = v0},
    {.name = "cache", .type = boolean, .versions = v0, .support = inert},
    {.name = "mis_compensation", .type = boolean, .versions = v3, .support = inert}};

constexpr Parameter kCollimated[] = {{"power", emission, "1", "in watts"}, kPlace};

constexpr Parameter kTurbidity{"turbidity", number, "3", "of the air, from 1 to 10"};
constexpr Parameter kGroundAlbedo{.name = "albedo",
                                  .type = reflectance,
                                  .preset = "0.3",
                                  .note = "of the ground",
                                  .preset_0x = "0.2"};
constexpr Parameter kYear{"year", integer, "2010"}, kMonth{"month", integer, "7"},
    kDay{"day", integer, "10"}, kHour{"hour", number, "15", "of the time zone"},
    kMinute{"minute", number, "0"}, kSecond{"second", number, "0"},
    kLatitude{"latitude", number, "35.6894", "degrees north"},
    kLongitude{"longitude", number, "139.6917", "degrees east"},
    kTimezone{"timezone", number, "9", "hours ahead of universal time"},
    kSunDirection{"sun_direction", point, "", "either this or time and place"},
    kSunScale{"sun_scale", number, "1", "multiplies the light of the sun; in 0.x instead of scale",
              not_negative},
    kSkyScale{"sky_scale", number, "1", "multiplies the light of the sky; in 0.x instead of scale",
              not_negative},
    kSunAperture{.name = "sun_aperture",
                 .type = number,
                 .preset = "0.5358",
                 .note = "in degrees",
                 .versions = v3},
    kComplexSun{.name = "complex_sun",
                .type = boolean,
                .preset = "false",
                .note = "as if it were false",
                .versions = v3,
                .support = approximated},
    kStretch{.name = "stretch",
             .type = number,
             .preset = "1",
             .note = "draws the sky below the horizon, up to 2",
             .versions = v0},
    kExtend{.name = "extend",
            .type = boolean,
            .preset = "false",
            .note = "the horizon goes on below",
            .versions = v0},
    kSunRadiusScale{.name = "sun_radius_scale",
                    .type = number,
                    .preset = "1",
                    .note = "the irradiance stays; 0: a directional light",
                    .range = not_negative,
                    .versions = v0},
    kSunTurbidity{"turbidity", number, "3", "of the air", not_negative},
    kSunStretch{.name = "stretch",
                .type = number,
                .preset = "1",
                .note = "multiplies the sun's angle from the zenith",
                .versions = v0},
    kSkyResolution{.name = "resolution",
                   .type = integer,
                   .note = "nothing is rasterised; 0.6 blurs the sun over some texels",
                   .versions = v0,
                   .support = inert};
constexpr Parameter kSky[] = {kTurbidity,  kGroundAlbedo, kYear,    kMonth,    kDay,
                              kHour,       kMinute,       kSecond,  kLatitude, kLongitude,
                              kTimezone,   kSunDirection, kStretch, kExtend,   kSkyResolution,
                              kLightScale, kToWorld};
constexpr Parameter kSun[] = {kSunTurbidity,   kYear,          kMonth,        kDay,
                              kHour,           kMinute,        kSecond,       kLatitude,
                              kLongitude,      kTimezone,      kSunDirection, kSunStretch,
                              kSunRadiusScale, kSkyResolution, kLightScale,   kToWorld};
constexpr Parameter kSunsky[] = {
    kTurbidity,      kGroundAlbedo,  kYear,        kMonth,      kDay,      kHour,
    kMinute,         kSecond,        kLatitude,    kLongitude,  kTimezone, kSunDirection,
    kSunScale,       kSkyScale,      kSunAperture, kComplexSun, kStretch,  kExtend,
    kSunRadiusScale, kSkyResolution, kLightScale,  kToWorld};
constexpr Parameter kTimedSunsky[] = {kTurbidity,
                                      kGroundAlbedo,
                                      {"start_year", integer, "2025"},
                                      {"start_month", integer, "1"},
                                      {"start_day", integer, "1"},
                                      {.name = "end_year", .type = integer, .support = inert},
                                      {.name = "end_month", .type = integer, .support = inert},
                                      {.name = "end_day", .type = integer, .support = inert},
                                      {"window_start_time", number, "7", "hour of the day"},
                                      {.name = "window_end_time", .type = number, .support = inert},
                                      kLatitude,
                                      kLongitude,
                                      kTimezone,
                                      kSunScale,
                                      kSkyScale,
                                      kSunAperture,
                                      kComplexSun,
                                      {.name = "shutter_open", .type = number, .support = inert},
                                      {.name = "shutter_close", .type = number, .support = inert},
                                      kToWorld};

const Plugin kEmitters[] = {
    {"area", both, kArea, &read_area, "stands in a shape"},
    {"point", both, kPoint, &read_point},
    {"spot", both, kSpot, &read_spot},
    {"projector", v3, kProjector, &read_projector},
    {"directional", both, kDirectional, &read_directional},
    {"constant", both, kConstant, &read_constant},
    {"envmap", both, kEnvmap, &read_envmap},
    {"directionalarea", v3, kArea, &read_directionalarea,
     "stands in a shape; only methods that walk from lights carry it"},
    {"collimated", v0, kCollimated, &read_collimated,
     "only methods that walk from lights carry it"},
    {"sunsky", both, kSunsky, &read_sunsky,
     "Hosek and Wilkie; in 0.x the sun is that of Preetham, Shirley and Smits"},
    {"timed_sunsky", v3, kTimedSunsky, &read_timed_sunsky, "at the start of the time",
     approximated},
    {"sky", v0, kSky, &read_sky},
    {"sun", v0, kSun, &read_sun, "Preetham, Shirley and Smits"},
    {.name = "volumelight",
     .versions = v3,
     .note = "a volume that emits is not computed, nor is it in Mitsuba 3.9",
     .support = refused,
     .refused_parameters = "radiance to_world"},
};

}  // namespace

std::span<const Plugin> emitters() {
  return kEmitters;
}

}  // namespace duet::vocabulary
