// Textures that pbrt has and Mitsuba has not, as plain data: see description_textures.h.
#pragma once

#include <memory>

#include "scene/description_base.h"
#include "scene/uv_field.h"
#include "textures/texture_kinds.h"

namespace duet {

class SceneBuilder;
class Texture;

namespace parameter_words {
inline constexpr Parameter kFromWorld{"from_world", transform, "", "from the world to the texture"};
}  // namespace parameter_words

/// Perlin's noise in space, in one of four forms: see NoiseKind and NoiseOptions.
struct NoiseTextureDescription {
  NoiseKind kind = NoiseKind::fbm;
  int octaves = 8;
  double roughness = 0.5;             ///< of an octave's amplitude to the one before
  double scale = 1, variation = 0.2;  ///< of marble
  Matrix4 from_world;

  static constexpr std::string_view kKinds[] = {"fbm", "wrinkled", "windy", "marble"};
  static constexpr auto fields() {
    using namespace parameter_words;
    using enum ParameterType;
    using T = NoiseTextureDescription;
    constexpr auto is_marble = [](const T& t) { return t.kind == NoiseKind::marble; };
    return FieldList(
        field(&T::kind, Parameter{"kind", string, kInitial, "fbm, wrinkled, windy or marble"})
            .words(kKinds),
        field(&T::octaves, Parameter{"octaves", integer, kInitial, "", size}),
        field(&T::roughness, Parameter{"roughness", number, kInitial, "", not_negative}),
        field(&T::scale, Parameter{"scale", number, kInitial, "of marble"}).when(is_marble),
        field(&T::variation, Parameter{"variation", number, kInitial, "of marble"}).when(is_marble),
        field(&T::from_world, kFromWorld));
  }
  static constexpr const char* name() { return "noise"; }
  std::unique_ptr<Texture> build(SceneBuilder& b, const SourceLocation& where) const;
};

/// Unit cubes of the texture's space; `color0` at the origin.
struct SolidCheckerboardDescription {
  ColorInput color0 = Spectrum(1.0f), color1 = Spectrum(0.0f);
  Matrix4 from_world;

  static constexpr auto fields() {
    using namespace parameter_words;
    using enum ParameterType;
    using T = SolidCheckerboardDescription;
    return FieldList(field(&T::color0, Parameter{"color0", unbounded, kInitial}).shown(" "),
                     field(&T::color1, Parameter{"color1", unbounded, kInitial}).shown(" and "),
                     field(&T::from_world, kFromWorld));
  }
  static constexpr const char* name() { return "solid_checkerboard"; }
  std::unique_ptr<Texture> build(SceneBuilder& b, const SourceLocation& where) const;
};

/// Another texture, looked up at coordinates that follow from the point in space. pbrt maps each
/// texture by itself: where a pattern holds textures of other mappings, it is a MixDescription of
/// them, by a mapped pattern of zeros and ones.
struct MappedTextureDescription {
  TextureId inner{};
  SpaceMapKind kind = SpaceMapKind::planar;
  Matrix4 from_world;

  static constexpr std::string_view kKinds[] = {"spherical", "cylindrical", "planar"};
  static constexpr auto fields() {
    using namespace parameter_words;
    using enum ParameterType;
    using T = MappedTextureDescription;
    return FieldList(
        field(&T::kind, Parameter{"mapping", string, kInitial, "spherical, cylindrical or planar"})
            .words(kKinds),
        field(&T::from_world, kFromWorld), field(&T::inner));
  }
  static constexpr const char* name() { return "mapped"; }
  std::unique_ptr<Texture> build(SceneBuilder& b, const SourceLocation& where) const;
};

/// (1 − amount) · first + amount · second.
struct MixDescription {
  ColorInput first = Spectrum(0.0f), second = Spectrum(1.0f);
  FloatInput amount = 0.5;

  static constexpr auto fields() {
    using namespace parameter_words;
    using enum ParameterType;
    using T = MixDescription;
    return FieldList(
        field(&T::first, Parameter{"first", unbounded, kInitial}).shown(" "),
        field(&T::second, Parameter{"second", unbounded, kInitial}).shown(" and "),
        field(&T::amount, Parameter{"amount", number_or_texture, kInitial, "share of the second"})
            .shown(", amount "));
  }
  static constexpr const char* name() { return "mix"; }
  std::unique_ptr<Texture> build(SceneBuilder& b, const SourceLocation& where) const;
};

/// The product of two textures, colour by colour.
struct ProductDescription {
  ColorInput first = Spectrum(1.0f), second = Spectrum(1.0f);

  static constexpr auto fields() {
    using namespace parameter_words;
    using enum ParameterType;
    using T = ProductDescription;
    return FieldList(field(&T::first, Parameter{"first", unbounded, kInitial}).shown(" "),
                     field(&T::second, Parameter{"second", unbounded, kInitial}).shown(" times "));
  }
  static constexpr const char* name() { return "product"; }
  std::unique_ptr<Texture> build(SceneBuilder& b, const SourceLocation& where) const;
};

/// a · first + (1 − a) · second, where a = |cos| of the angle between the geometric normal and
/// the direction.
struct DirectionMixDescription {
  ColorInput first = Spectrum(0.0f), second = Spectrum(1.0f);
  double x = 0, y = 1, z = 0;  ///< the direction in the world, of any length

  static constexpr auto fields() {
    using namespace parameter_words;
    using enum ParameterType;
    using T = DirectionMixDescription;
    return FieldList(
        field(&T::first, Parameter{"first", unbounded, kInitial, "along the direction"}).shown(" "),
        field(&T::second, Parameter{"second", unbounded, kInitial, "across it"}).shown(" and "),
        field(&T::x, Parameter{"x", number, kInitial, "of the direction in the world"}),
        field(&T::y, Parameter{"y", number, kInitial}),
        field(&T::z, Parameter{"z", number, kInitial}));
  }
  static constexpr const char* name() { return "directionmix"; }
  std::unique_ptr<Texture> build(SceneBuilder& b, const SourceLocation& where) const;
};

/// A function of another texture: see TextureFunction.
struct FunctionDescription {
  TextureId inner{};
  TextureFunction function = TextureFunction::inverse;

  static constexpr std::string_view kFunctions[] = {"inverse", "root", "v3_roughness", "metal_k",
                                                    "positive"};
  static constexpr auto fields() {
    using namespace parameter_words;
    using enum ParameterType;
    using T = FunctionDescription;
    return FieldList(
        field(&T::function,
              Parameter{"function", string, kInitial,
                        "inverse: 1 - x; root: of x; v3_roughness: pbrt-v3's remapping; "
                        "metal_k: of a metal that reflects x; positive: whether x is"})
            .words(kFunctions),
        field(&T::inner));
  }
  static constexpr const char* name() { return "function"; }
  std::unique_ptr<Texture> build(SceneBuilder& b, const SourceLocation& where) const;
};

/// Linear between four corners; `v01` is at u = 0, v = 1. It goes on beyond the unit square, or
/// begins anew in each.
struct BilerpDescription {
  Spectrum v00{0.0f}, v01{1.0f}, v10{0.0f}, v11{1.0f};
  UvTransform to_uv;
  bool repeats = false;

  static constexpr auto fields() {
    using namespace parameter_words;
    using enum ParameterType;
    using T = BilerpDescription;
    return FieldList(
        field(&T::v00, Parameter{"v00", unbounded, kInitial, "constant"}),
        field(&T::v01, Parameter{"v01", unbounded, kInitial, "at u = 0, v = 1"}),
        field(&T::v10, Parameter{"v10", unbounded, kInitial, "constant"}),
        field(&T::v11, Parameter{"v11", unbounded, kInitial, "constant"}), uv_field(&T::to_uv),
        field(&T::repeats,
              Parameter{"repeats", boolean, kInitial, "begins anew in each unit square"})
            .terse());
  }
  static constexpr const char* name() { return "bilerp"; }
  std::unique_ptr<Texture> build(SceneBuilder& b, const SourceLocation& where) const;
};

/// Round dots: see DotsTexture.
struct DotsDescription {
  ColorInput inside = Spectrum(1.0f), outside = Spectrum(0.0f);
  UvTransform to_uv;

  static constexpr auto fields() {
    using namespace parameter_words;
    using enum ParameterType;
    using T = DotsDescription;
    return FieldList(field(&T::inside, Parameter{"inside", unbounded, kInitial}).shown(" "),
                     field(&T::outside, Parameter{"outside", unbounded, kInitial}).shown(" and "),
                     uv_field(&T::to_uv));
  }
  static constexpr const char* name() { return "dots"; }
  std::unique_ptr<Texture> build(SceneBuilder& b, const SourceLocation& where) const;
};

}  // namespace duet
