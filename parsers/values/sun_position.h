// Where the sun stands at a time and place.
#pragma once

#include <array>

#include "scene/description.h"

namespace duet {

struct SunTime {
  int year = 2010, month = 7, day = 10;
  double hour = 15, minute = 0, second = 0;  ///< of the time zone
  static constexpr auto fields() {
    using namespace parameter_words;
    using T = SunTime;
    return FieldList(field(&T::year, Parameter{"year", integer, kInitial}),
                     field(&T::month, Parameter{"month", integer, kInitial}),
                     field(&T::day, Parameter{"day", integer, kInitial}),
                     field(&T::hour, Parameter{"hour", number, kInitial, "of the time zone"}),
                     field(&T::minute, Parameter{"minute", number, kInitial}),
                     field(&T::second, Parameter{"second", number, kInitial}));
  }
};
struct SunPlace {
  double latitude = 35.6894, longitude = 139.6917;  ///< degrees, north and east
  double timezone = 9;                              ///< hours ahead of universal time
  static constexpr auto fields() {
    using namespace parameter_words;
    using P = SunPlace;
    return FieldList(field(&P::latitude, Parameter{"latitude", number, kInitial, "degrees north"}),
                     field(&P::longitude, Parameter{"longitude", number, kInitial, "degrees east"}),
                     field(&P::timezone, Parameter{"timezone", number, kInitial,
                                                   "hours ahead of universal time"}));
  }
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
