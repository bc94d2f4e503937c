#include "values/sun_position.h"

#include <cmath>
#include <numbers>

#include "math/angles.h"

namespace duet {

SunAngles sun_angles(const SunTime& time, const SunPlace& place) {
  constexpr double radians = kRadians;
  // Days since noon of the first of January 2000, universal time.
  const double hours = time.hour - place.timezone + (time.minute + time.second / 60) / 60;
  const long early = (time.month - 14) / 12;  // −1 in January and February
  const long julian = 1461 * (time.year + 4800 + early) / 4 +
                      367 * (time.month - 2 - 12 * early) / 12 -
                      3 * ((time.year + 4900 + early) / 100) / 4 + time.day - 32075;
  const double days = double(julian) - 0.5 + hours / 24 - 2451545;

  // The ecliptic.
  const double node = 2.1429 - 0.0010394594 * days;
  const double mean_longitude = 4.8950630 + 0.017202791698 * days;
  const double anomaly = 6.2400600 + 0.0172019699 * days;
  const double longitude = mean_longitude + 0.03341607 * std::sin(anomaly) +
                           0.00034894 * std::sin(2 * anomaly) - 0.0001134 -
                           0.0000203 * std::sin(node);
  const double obliquity = 0.4090928 - 6.2140e-9 * days + 0.0000396 * std::cos(node);

  // The celestial sphere.
  const double right_ascension =
      std::atan2(std::cos(obliquity) * std::sin(longitude), std::cos(longitude));
  const double declination = std::asin(std::sin(obliquity) * std::sin(longitude));

  // The horizon of the place.
  const double sidereal = 6.6974243242 + 0.0657098283 * days + hours;
  const double hour_angle = (sidereal * 15 + place.longitude) * radians - right_ascension;
  const double latitude = place.latitude * radians;
  const double zenith =
      std::acos(std::cos(latitude) * std::cos(hour_angle) * std::cos(declination) +
                std::sin(declination) * std::sin(latitude));
  const double azimuth =
      std::atan2(-std::sin(hour_angle), std::tan(declination) * std::cos(latitude) -
                                            std::sin(latitude) * std::cos(hour_angle));
  constexpr double earth_radius = 6371.01, astronomical_unit = 149597890;  // km
  return {zenith + earth_radius / astronomical_unit * std::sin(zenith), azimuth};
}

std::array<double, 3> sun_direction_3x(const SunAngles& a) {
  const double azimuth = a.azimuth - std::numbers::pi, s = std::sin(a.zenith);
  return {s * std::cos(azimuth), s * std::sin(azimuth), std::cos(a.zenith)};
}

std::array<double, 3> sun_direction_0x(const SunAngles& a) {
  const double s = std::sin(a.zenith);
  return {s * std::sin(a.azimuth), std::cos(a.zenith), -s * std::cos(a.azimuth)};
}

}  // namespace duet
