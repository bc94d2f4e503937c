// What the descriptions of methods that trace paths share.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "lights/light_selection.h"
#include "scene/field.h"

namespace duet {

namespace parameter_words {
inline constexpr Parameter kRrDepth{"rr_depth", integer, kInitial,
                                    "segments before Russian roulette begins (Mitsuba: 5)",
                                    positive};
inline constexpr Parameter kHideEmitters{"hide_emitters", boolean, kInitial,
                                         "lights cannot be seen directly"};
inline constexpr Parameter kStrictNormals{
    "strict_normals", boolean, kInitial, "drop paths whose shading and geometric normals disagree"};
/// Of methods that Mitsuba 3 has, too, but without it.
inline constexpr Parameter kStrictNormals0x{
    "strict_normals",
    boolean,
    kInitial,
    "drop paths whose shading and geometric normals disagree",
    any,
    v0};
inline constexpr Parameter kLightSelection{
    "light_selection", string, kInitial,
    "by what light samples choose a light: auto, bvh, power or uniform (docs/lights.md)"};
inline constexpr Parameter kPixelGroup{
    "pixel_group", integer, kInitial,
    "Duet's own: so many pixels of a tile use one another's paths from the second vertex on (1 to "
    "64)",
    size};
constexpr Parameter max_depth_parameter(
    std::string_view note = "longest path in segments; -1: no limit") {
  return {"max_depth", integer, kInitial, note, depth};
}
}  // namespace parameter_words

/// `rr_depth` unless a scene says otherwise (docs/roulette.md).
inline constexpr int kUsualRrDepth = 2;

/// Pixels in a group (docs/pixel_groups.md).
inline constexpr int kMostInGroup = 64;

/// What all methods that trace paths of any length share.
struct PathLimits {
  int max_depth = -1;            ///< longest path in segments; −1 is no limit
  int rr_depth = kUsualRrDepth;  ///< segments before Russian roulette begins
  bool hide_emitters = false;
  /// Ignore directions that the shading and the geometric normal see on different sides.
  bool strict_normals = false;
  LightSelection light_selection = LightSelection::automatic;

  static constexpr auto limits(const Parameter& max_depth) {
    using namespace parameter_words;
    using L = PathLimits;
    return FieldList(field(&L::max_depth, max_depth), field(&L::rr_depth, kRrDepth),
                     field(&L::hide_emitters, kHideEmitters));
  }
  /// What Mitsuba 3 does not have.
  static constexpr auto own_fields() {
    using namespace parameter_words;
    using L = PathLimits;
    return FieldList(
        field(&L::strict_normals, kStrictNormals0x).unwritten(),
        field(&L::light_selection, kLightSelection).words(kLightSelectionNames).unwritten());
  }
  static constexpr auto fields() {
    return joined_fields(limits(parameter_words::max_depth_parameter()), own_fields());
  }
  std::vector<std::string> losses() const { return own_losses(strict_normals, light_selection); }
  static std::vector<std::string> own_losses(bool strict, LightSelection selection) {
    std::vector<std::string> lost;
    if (strict) lost.emplace_back("\"strict_normals\" does not exist in Mitsuba 3");
    if (selection != LightSelection::automatic)
      lost.emplace_back("\"light_selection\" does not exist in Mitsuba 3");
    return lost;
  }
};

}  // namespace duet
