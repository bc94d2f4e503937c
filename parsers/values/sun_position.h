// Where the sun stands at a time and place.
#pragma once

#include <array>

namespace duet {

struct SunTime {
  int year = 2010, month = 7, day = 10;
  double hour = 15, minute = 0, second = 0;  ///< of the time zone
};
struct SunPlace {
  double latitude = 35.6894, longitude = 139.6917;  ///< degrees, north and east
  double timezone = 9;                              ///< hours ahead of universal time
};

/// Angles in radians: from the zenith, and clockwise from north.
struct SunAngles {
  double zenith, azimuth;
};

/// Valid from 1999 to 2015 to half a minute of arc, and little worse for long around.
/// Source: Blanco-Muriel et al., "Computing the Solar Vector", Solar Energy 70(5), 2001.
SunAngles sun_angles(const SunTime& time, const SunPlace& place);

/// The direction to it as Mitsuba 3 places it: x to the north, z up, azimuths from the south to the
/// east.
std::array<double, 3> sun_direction_3x(const SunAngles& angles);
/// The same of Mitsuba 0.x: x to the east, −z to the north, y up.
std::array<double, 3> sun_direction_0x(const SunAngles& angles);

}  // namespace duet
