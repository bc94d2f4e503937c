// The transform of texture coordinates, as several textures have it.
#pragma once

#include "math/transform.h"
#include "scene/field.h"

namespace duet {

namespace parameter_words {
inline constexpr Parameter kToUv{"to_uv", transform, "", "applied to texture coordinates", any, v3};
inline constexpr Parameter kUOffset{"uoffset", number, "0", "", any, v0};
inline constexpr Parameter kVOffset{"voffset", number, "0", "", any, v0};
inline constexpr Parameter kUScale{"uscale", number, "(uvscale)", "", any, v0};
inline constexpr Parameter kVScale{"vscale", number, "(uvscale)", "", any, v0};
inline constexpr Parameter kUvScale{"uvscale", number, "1", "", any, v0};
inline constexpr Parameter kCoordinates{"coordinates", string, "uv", "", any, v0, inert};
}  // namespace parameter_words

/// Mitsuba 3 has a transform, 0.x offsets and scales.
template <class T>
constexpr auto uv_field(UvTransform T::*member) {
  using namespace parameter_words;
  return field(member, kToUv, kUOffset, kVOffset, kUScale, kVScale, kUvScale, kCoordinates);
}
/// Of a texture that only 0.x has.
template <class T>
constexpr auto uv_field_0x(UvTransform T::*member) {
  using namespace parameter_words;
  return field(member, kUOffset, kVOffset, kUScale, kVScale, kUvScale, kCoordinates);
}

}  // namespace duet
