// Sun and sky of both Mitsubas.
#include <cmath>
#include <numbers>
#include <span>

#include "mitsuba/readers.h"
#include "mitsuba/scene_reader.h"
#include "mitsuba/sun_position.h"
#include "mitsuba/sun_radiance.h"

namespace duet {

namespace {

constexpr const char* kTimeAndPlace[] = {"year",   "month",    "day",       "hour",    "minute",
                                         "second", "latitude", "longitude", "timezone"};
/// Those that 0.x refuses beside a direction; the others have no effect there.
constexpr const char* kDayAndPlace[] = {"day", "latitude", "longitude", "timezone"};

SunPlace read_place(Properties& p) {
  return {p.number("latitude"), p.number("longitude"), p.number("timezone")};
}

SunAngles read_time_and_place(Properties& p) {
  SunTime time;
  time.year = p.integer("year");
  time.month = p.integer("month");
  time.day = p.integer("day");
  time.hour = p.number("hour");
  time.minute = p.number("minute");
  time.second = p.number("second");
  return sun_angles(time, read_place(p));
}

double limited(Properties& p, std::string_view name, double least, double most) {
  const double value = p.number(name);
  if (value >= least && value <= most) return value;
  p.error(name, "the {} {} is not between {} and {}", name, value, least, most);
  return least;
}

/// Turbidity and the ground.
void read_air(SceneReader& s, Properties& p, SkyLight& sky) {
  sky.turbidity = limited(p, "turbidity", 1, 10);
  sky.albedo = s.constant_color(p, "albedo");
  if (sky.albedo.max() > 1) p.error("albedo", "the albedo of the ground is at most 1");
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

void warn_below_horizon(SceneReader& s, Properties& p, const SkyLight& sky) {
  if (sky.sun[2] < 0)
    s.report().warning(p.node().where, "the sun is below the horizon: {} is dark",
                       describe(p.node()));
}

void read_common(Properties& p, LightDescription& out) {
  out.sampling_weight = p.number("sampling_weight");
}

/// x to the north, z up, where azimuths run to the east by south: as in Mitsuba 3.
std::array<double, 3> direction_3x(const SunAngles& a) {
  constexpr double pi = std::numbers::pi;
  const double azimuth = a.azimuth - pi, s = std::sin(a.zenith);
  return {s * std::cos(azimuth), s * std::sin(azimuth), std::cos(a.zenith)};
}

void read_sky_3x(SceneReader& s, Properties& p, SkyLight& sky) {
  read_air(s, p, sky);
  sky.sun_scale = p.number("sun_scale");
  sky.sky_scale = p.number("sky_scale");
  sky.sun_aperture = p.number("sun_aperture");
  if (!(sky.sun_aperture > 0 && sky.sun_aperture < 180))
    p.error("sun_aperture", "the aperture of the sun is between 0 and 180 degrees, not {}",
            sky.sun_aperture);
  if (p.boolean("complex_sun"))
    s.approximate_loudly(p.where("complex_sun"),
                         "the disk of the sun has the same radiance everywhere");
}

/// In 0.x +y is up; the model's +z.
Matrix4 y_up() {
  Matrix4 m;
  m[0] = {1, 0, 0, 0};
  m[1] = {0, 0, 1, 0};
  m[2] = {0, -1, 0, 0};
  return m;
}

/// What "sky", "sun" and "sunsky" of 0.6 have in common.
void read_0x(SceneReader& s, Properties& p, SkyLight& sky, LightDescription& out) {
  out.to_world = p.transform("to_world");
  // With y up: x to the east and −z to the north.
  Triple y_up_sun;
  if (const auto given = given_direction(p)) {
    // The direction is one of the world.
    y_up_sun = *given;
    if (const auto to_local = out.to_world.inverse())
      for (int i = 0; i < 3; ++i) {
        const auto& row = (*to_local)[i];
        y_up_sun[size_t(i)] = row[0] * (*given)[0] + row[1] * (*given)[1] + row[2] * (*given)[2];
      }
  } else {
    const SunAngles a = read_time_and_place(p);
    const double r = std::sin(a.zenith);
    y_up_sun = {r * std::sin(a.azimuth), std::cos(a.zenith), -r * std::cos(a.azimuth)};
  }
  sky.sun = {y_up_sun[0], -y_up_sun[2], y_up_sun[1]};
  if (sky.sun[2] < 0) s.report().error(p.node().where, "the sun is below the horizon");
  out.to_world = out.to_world * y_up();
  read_common(p, out);
}

void read_stretch(Properties& p, SkyLight& sky) {
  sky.stretch = limited(p, "stretch", 1, 2);
  sky.extend = p.boolean("extend");
}

/// The disk of 0.x, which is stretched away from the zenith like the sky; its brightness is that of
/// the true place.
SunDisk sun_disk(const SkyLight& sky, double stretch) {
  const auto& [x, y, z] = sky.sun;
  const double across = std::hypot(x, y), zenith = std::atan2(across, z);
  SunDisk disk;
  disk.irradiance = sun_irradiance_0x(sky.turbidity, zenith);
  if (across > 0) {
    const double r = std::sin(zenith * stretch) / across;
    disk.direction = {x * r, y * r, std::cos(zenith * stretch)};
  }
  return disk;
}

/// A sun without a size, seen from the world; `to_world` is the sky's.
LightDescription directional_sun(const SunDisk& disk, double scale, const LightDescription& sky) {
  Triple d{};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      d[size_t(i)] -= sky.to_world[i][size_t(j)] * disk.direction[size_t(j)];
  LightDescription out = sky;
  out.model = DirectionalLight{disk.irradiance * float(scale)};
  out.to_world = along(d).value_or(Matrix4{});
  return out;
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

}  // namespace

void read_sky(SceneReader& s, Properties& p, LightDescription& out) {
  SkyLight sky;
  read_air(s, p, sky);
  read_0x(s, p, sky, out);
  read_stretch(p, sky);
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
  sky.disk = sun_disk(sky, limited(p, "stretch", 1, 2));
  if (const auto aperture = read_sun_aperture(p)) {
    sky.sun_aperture = *aperture;
    out.model = sky;
  } else {
    out = directional_sun(*sky.disk, sky.sun_scale, out);
  }
}

namespace {

void read_sunsky_0x(SceneReader& s, Properties& p, LightDescription& out) {
  SkyLight sky;
  read_air(s, p, sky);
  read_0x(s, p, sky, out);
  read_stretch(p, sky);
  const double scale = p.number("scale");
  sky.sky_scale = p.has("sky_scale") ? p.number("sky_scale") : scale;
  sky.sun_scale = p.has("sun_scale") ? p.number("sun_scale") : scale;
  sky.disk = sun_disk(sky, sky.stretch);
  if (const auto aperture = read_sun_aperture(p)) {
    sky.sun_aperture = *aperture;
  } else {
    s.description().lights.push_back(directional_sun(*sky.disk, sky.sun_scale, out));
    sky.sun_scale = 0;
    sky.disk.reset();
  }
  out.model = sky;
}

}  // namespace

void read_sunsky(SceneReader& s, Properties& p, LightDescription& out) {
  if (p.is_0x()) return read_sunsky_0x(s, p, out);
  SkyLight sky;
  read_sky_3x(s, p, sky);
  out.to_world = p.transform("to_world");
  read_common(p, out);
  if (const auto given = given_direction(p)) {
    sky.sun = *given;
    if (const auto to_local = out.to_world.inverse())
      for (int i = 0; i < 3; ++i) {
        const auto& row = (*to_local)[i];
        sky.sun[size_t(i)] = row[0] * (*given)[0] + row[1] * (*given)[1] + row[2] * (*given)[2];
      }
  } else {
    sky.sun = direction_3x(read_time_and_place(p));
  }
  warn_below_horizon(s, p, sky);
  out.model = sky;
}

void read_timed_sunsky(SceneReader& s, Properties& p, LightDescription& out) {
  SkyLight sky;
  read_sky_3x(s, p, sky);
  out.to_world = p.transform("to_world");
  read_common(p, out);
  SunTime time;
  time.year = p.integer("start_year");
  time.month = p.integer("start_month");
  time.day = p.integer("start_day");
  time.hour = limited(p, "window_start_time", 0, 24);
  sky.sun = direction_3x(sun_angles(time, read_place(p)));
  s.approximate_loudly(p.node().where,
                       "nothing moves: the sun stands where it is at the start of the time");
  warn_below_horizon(s, p, sky);
  out.model = sky;
}

void read_collimated(SceneReader& s, Properties& p, LightDescription& out) {
  out.model = CollimatedLight{s.constant_color(p, "power")};
  out.to_world = p.transform("to_world", out.motion);
  out.sampling_weight = p.number("sampling_weight");
  if (const Node* medium = p.child(PluginKind::medium)) out.medium = s.medium(*medium);
}

void read_directionalarea(SceneReader& s, Properties& p, AreaEmission& out) {
  out.radiance = s.color(p, "radiance");
  out.sampling_weight = p.number("sampling_weight");
  out.directional = true;
  p.child(PluginKind::medium);
}

}  // namespace duet
