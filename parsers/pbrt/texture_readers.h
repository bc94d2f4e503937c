// What the readers of textures share, and their tables.
#pragma once

#include "pbrt/records.h"
#include "pbrt/values.h"

namespace duet::pbrt {

/// A texture while it is read: of colours, or of numbers.
struct Request {
  bool is_color;
  ColorMeaning meaning = ColorMeaning::reflectance;
};
/// Only the one that was asked for counts.
struct Made {
  ColorInput color = Spectrum(0.0f);
  FloatInput number = 0.0;
};

using ReadTexture = void (*)(Values&, const Request&, Made&);
/// Patterns by formulas (texture_patterns.cpp).
std::span<const Record<ReadTexture>> pattern_textures();

#define DUET_MAPPING_SPECS                                                                      \
  {"mapping", kString, "uv", "uv, spherical, cylindrical or planar"}, {"uscale", kNumber, "1"}, \
      {"vscale", kNumber, "1"}, {"udelta", kNumber, "0"}, {"vdelta", kNumber, "0"},             \
      {"v1", kVector3, "1 0 0"}, {                                                              \
    "v2", kVector3, "0 1 0"                                                                     \
  }
constexpr Types kEither = kColorTexture | kNumberTexture;

/// From the world to the space of the texture: the transform that held at the directive.
Matrix4 from_world(Values& v);
/// From the surface's coordinates to the texture's (s, t).
UvTransform mapping(Values& v);
/// The texture looked up where its mapping says, unless that is by the surface's coordinates.
TextureId mapped(Values& v, TextureId texture);
/// Both forms of a texture that is not constant.
void set(Made& made, TextureId id);
/// A value of one of the texture's own parameters.
void read_input(Values& v, const Request& request, std::string_view name, Made& made);
/// The same as a colour, also where a number was asked for.
ColorInput color_of(Values& v, const Request& request, std::string_view name);

}  // namespace duet::pbrt
