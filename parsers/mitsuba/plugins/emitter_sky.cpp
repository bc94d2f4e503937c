// Sun and sky of both Mitsubas.
#include <span>

#include "mitsuba/plugins/emitter.h"
#include "mitsuba/unstretched.h"
#include "values/sun_position.h"
#include "values/sun_radiance.h"

namespace duet::plugins {

namespace {

constexpr const char* kTimeAndPlace[] = {"year",   "month",    "day",       "hour",    "minute",
                                         "second", "latitude", "longitude", "timezone"};
/// Those that 0.x refuses beside a direction; the others have no effect there.
constexpr const char* kDayAndPlace[] = {"day", "latitude", "longitude", "timezone"};

SunPlace read_place(SceneReader& s, Properties& p) {
  SunPlace place;
  read_values(s, p, place);
  return place;
}

SunAngles read_time_and_place(SceneReader& s, Properties& p) {
  SunTime time;
  read_values(s, p, time);
  return sun_angles(time, read_place(s, p));
}

double limited(Properties& p, std::string_view name, double value, double least, double most) {
  if (value >= least && value <= most) return value;
  p.error(name, "the {} {} is not between {} and {}", name, value, least, most);
  return least;
}

/// What the fields say; turbidity, ground and stretch have limits.
void read_air(SceneReader& s, Properties& p, SkyLight& sky) {
  read_values(s, p, sky);
  sky.turbidity = limited(p, "turbidity", sky.turbidity, 1, 10);
  if (sky.albedo.max() > 1) p.error("albedo", "the albedo of the ground is at most 1");
  if (p.knows("stretch")) sky.stretch = limited(p, "stretch", sky.stretch, 1, 2);
}

/// The direction to the sun that a file gives, or nothing.
std::optional<Triple> given_direction(Properties& p) {
  if (!p.has("sun_direction")) return std::nullopt;
  const std::span<const char* const> forbidden =
      p.is_0x() ? std::span<const char* const>(kDayAndPlace) : kTimeAndPlace;
  for (const char* name : forbidden)
    if (p.has(name)) {
      p.error(name, "either \"sun_direction\" or time and place can be given");
      break;
    }
  const Triple d = p.triple("sun_direction");
  if (d[0] != 0 || d[1] != 0 || d[2] != 0) return d;
  p.error("sun_direction", "the direction to the sun cannot be zero");
  return std::nullopt;
}

/// A direction in the world as one in the sky's own space, which is turned, but not stretched.
Triple seen_from_sky(const Triple& direction, const Matrix4& to_world) {
  const auto to_local = unstretched(to_world).value_or(to_world).inverse();
  return to_local ? to_local->turned(direction) : direction;
}

void warn_below_horizon(SceneReader& s, Properties& p, const SkyLight& sky) {
  if (sky.sun[2] < 0)
    s.report().warning(p.node().where, "the sun is below the horizon: {} is dark",
                       describe(p.node()));
}

void read_sky_3x(SceneReader& s, Properties& p, SkyLight& sky) {
  read_air(s, p, sky);
  if (!(sky.sun_aperture > 0 && sky.sun_aperture < 180))
    p.error("sun_aperture", "the aperture of the sun is between 0 and 180 degrees, not {}",
            sky.sun_aperture);
  if (p.boolean("complex_sun"))
    s.approximate_loudly(p.where("complex_sun"),
                         "the disk of the sun has the same radiance everywhere");
}

/// What "sky", "sun" and "sunsky" of 0.6 have in common.
void read_0x(SceneReader& s, Properties& p, SkyLight& sky, LightDescription& out) {
  out.to_world = p.transform("to_world");
  warn_of_scales(s, p, out.to_world);
  Triple y_up_sun;
  if (const auto given = given_direction(p)) {
    y_up_sun = seen_from_sky(*given, out.to_world);
  } else {
    y_up_sun = sun_direction_0x(read_time_and_place(s, p));
  }
  sky.sun = {y_up_sun[0], -y_up_sun[2], y_up_sun[1]};
  if (sky.sun[2] < 0) s.report().error(p.node().where, "the sun is below the horizon");
  out.to_world = out.to_world * y_up_sky();
  read_weight(p, out);
}

/// How wide the sun of 0.x is; nothing if it is a directional light.
std::optional<double> read_sun_aperture(Properties& p) {
  const double scale = p.number("sun_radius_scale");
  if (scale == 0) return std::nullopt;
  // What is smaller throws the same shadows, but single precision cannot tell where it is.
  constexpr double smallest = 0.02;
  const double aperture = kSunAperture0x * std::max(scale, smallest);
  if (!(aperture < 180))
    p.error("sun_radius_scale", "the sun is {:g} degrees wide, which is not less than 180",
            aperture);
  return aperture;
}

void read_sky(SceneReader& s, Properties& p, LightDescription& out) {
  SkyLight sky;
  read_air(s, p, sky);
  read_0x(s, p, sky, out);
  sky.sky_scale = p.number("scale");
  sky.sun_scale = 0;
  out.model = sky;
}

void read_sun(SceneReader& s, Properties& p, LightDescription& out) {
  SkyLight sky;
  sky.turbidity = p.number("turbidity");
  read_0x(s, p, sky, out);
  sky.sky_scale = 0;
  sky.sun_scale = p.number("scale");
  sky.disk = sun_disk_0x(sky.sun, sky.turbidity, limited(p, "stretch", p.number("stretch"), 1, 2));
  if (const auto aperture = read_sun_aperture(p)) {
    sky.sun_aperture = *aperture;
    out.model = sky;
  } else {
    out = directional_sun(*sky.disk, sky.sun_scale, out);
  }
}

void read_sunsky_0x(SceneReader& s, Properties& p, LightDescription& out) {
  SkyLight sky;
  read_air(s, p, sky);
  read_0x(s, p, sky, out);
  const double scale = p.number("scale");
  if (!p.has("sky_scale")) sky.sky_scale = scale;
  if (!p.has("sun_scale")) sky.sun_scale = scale;
  sky.disk = sun_disk_0x(sky.sun, sky.turbidity, sky.stretch);
  if (const auto aperture = read_sun_aperture(p)) {
    sky.sun_aperture = *aperture;
  } else {
    s.description().lights.push_back(directional_sun(*sky.disk, sky.sun_scale, out));
    sky.sun_scale = 0;
    sky.disk.reset();
  }
  out.model = sky;
}

void read_sunsky(SceneReader& s, Properties& p, LightDescription& out) {
  if (p.is_0x()) return read_sunsky_0x(s, p, out);
  SkyLight sky;
  read_sky_3x(s, p, sky);
  out.to_world = p.transform("to_world");
  warn_of_scales(s, p, out.to_world);
  read_weight(p, out);
  if (const auto given = given_direction(p)) {
    sky.sun = seen_from_sky(*given, out.to_world);
  } else {
    sky.sun = sun_direction_3x(read_time_and_place(s, p));
  }
  warn_below_horizon(s, p, sky);
  out.model = sky;
}

void read_timed_sunsky(SceneReader& s, Properties& p, LightDescription& out) {
  SkyLight sky;
  read_sky_3x(s, p, sky);
  out.to_world = p.transform("to_world");
  warn_of_scales(s, p, out.to_world);
  read_weight(p, out);
  SunTime time;
  time.year = p.integer("start_year");
  time.month = p.integer("start_month");
  time.day = p.integer("start_day");
  time.hour = limited(p, "window_start_time", p.number("window_start_time"), 0, 24);
  sky.sun = sun_direction_3x(sun_angles(time, read_place(s, p)));
  s.approximate_loudly(p.node().where,
                       "nothing moves: the sun stands where it is at the start of the time");
  warn_below_horizon(s, p, sky);
  out.model = sky;
}

constexpr Parameter kToWorld{"to_world", transform};
constexpr Parameter kComplexSun{"complex_sun", boolean, "false",     "as if it were false",
                                any,           v3,      approximated};
constexpr Parameter kSunRadiusScale{
    "sun_radius_scale", number, "1", "the irradiance stays; 0: a directional light",
    not_negative,       v0};
constexpr Parameter kSunTurbidity{"turbidity", number, "3", "of the air", not_negative};
constexpr Parameter kSunStretch{
    "stretch", number, "1", "multiplies the sun's angle from the zenith", any, v0};
constexpr Parameter kSkyResolution{
    "resolution", integer, "",   "nothing is rasterised; 0.6 blurs the sun over some texels",
    any,          v0,      inert};
constexpr Parameter kStart[] = {
    {"start_year", integer, "2025"}, {"start_month", integer, "1"}, {"start_day", integer, "1"}};

}  // namespace

std::vector<Plugin> skies() {
  const auto of_sky = [](std::string_view name) { return parameter<SkyLight>(name); };
  const ParameterList time(parameters_of<SunTime>()), place(parameters_of<SunPlace>());
  const ParameterList air(of_sky("turbidity"), of_sky("albedo"));
  const ParameterList below(of_sky("stretch"), of_sky("extend"));
  const ParameterList scales(of_sky("sun_scale"), of_sky("sky_scale"), of_sky("sun_aperture"),
                             kComplexSun);
  const Parameter sun = of_sky("sun_direction"), scale = parameter<ProjectorLight>("scale");
  return {
      {"sunsky",
       both,
       {air, time, place, sun, scales, below, kSunRadiusScale, kSkyResolution, scale, kToWorld},
       &read_sunsky,
       "Hosek and Wilkie; in 0.x the sun is that of Preetham, Shirley and Smits"},
      {"timed_sunsky",
       v3,
       {air, kStart, inert_parameters(integer, "end_year end_month end_day"),
        Parameter{"window_start_time", number, "7", "hour of the day"},
        inert_parameters(number, "window_end_time"), place, scales,
        inert_parameters(number, "shutter_open shutter_close"), kToWorld},
       &read_timed_sunsky,
       "at the start of the time",
       approximated},
      {"sky", v0, {air, time, place, sun, below, kSkyResolution, scale, kToWorld}, &read_sky},
      {"sun",
       v0,
       {kSunTurbidity, time, place, sun, kSunStretch, kSunRadiusScale, kSkyResolution, scale,
        kToWorld},
       &read_sun,
       "Preetham, Shirley and Smits"},
  };
}

}  // namespace duet::plugins
