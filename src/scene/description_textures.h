// Textures as plain data: what is known of each stands in its struct. Besides its fields (field.h)
// it has the name that Mitsuba has for it and build(), which returns null after an error; it may
// have losses(): sentences about what Mitsuba 3 has no way to say of it, or kOnlyIn0x;
// kAsksForColors, if it asks textures in it for colours even where it yields a number.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "scene/description_base.h"
#include "scene/description_pbrt_textures.h"
#include "scene/uv_field.h"
#include "textures/bitmap_options.h"
#include "textures/curvature_kind.h"

namespace duet {

class SceneBuilder;
class Texture;

struct BitmapTexture {
  std::string file;  ///< resolved path
  TextureFilter filter = TextureFilter::bilinear;
  WrapMode wrap_u = WrapMode::repeat, wrap_v = WrapMode::repeat;
  /// Values are data, not colours: nothing is decoded.
  bool raw = false;
  /// Overrides the file's transfer curve: 1 is linear, −1 sRGB, another number a power. Absent:
  /// sRGB for 8-bit files, linear for floating-point files.
  std::optional<double> gamma;
  TextureChannel channel = TextureChannel::all;
  UvTransform to_uv;
  /// From the image's colour space to that of the other colours, if it is another one.
  std::optional<ColorMatrix> colors = std::nullopt;
  /// Values above one are one, and negative ones zero.
  bool clamped = false;

  static constexpr std::string_view kFilters[] = {"nearest", "bilinear"};
  /// Those of Mitsuba 3: it has no texture that is zero or one outside of its image.
  static constexpr std::string_view kWrapModes[] = {"repeat", "mirror", "clamp", "clamp", "clamp"};
  static constexpr auto fields() {
    using namespace parameter_words;
    using enum ParameterType;
    using T = BitmapTexture;
    return FieldList(
        field(&T::file, Parameter{.name = "filename", .type = file, .required = true})
            .names_data()
            .shown(" "),
        field(&T::filter,
              Parameter{.name = "filter_type",
                        .type = string,
                        .preset = kInitial,
                        .note = "nearest or bilinear; ewa and trilinear of 0.x are approximated by "
                                "bilinear",
                        .preset_0x = "ewa"})
            .words(kFilters)
            .terse()
            .read_by_plugin(),
        field(&T::wrap_u,
              Parameter{"wrap_mode", string, kInitial,
                        "repeat, mirror, clamp; in 0.x also zero and one"},
              Parameter{"wrap_mode_u", string, "(wrap_mode)", "", any, v0})
            .words(kWrapModes)
            .terse()
            .read_by_plugin(),
        field(&T::wrap_v, Parameter{"wrap_mode_v", string, "(wrap_mode)", "", any, v0})
            .unwritten()
            .read_by_plugin(),
        field(&T::raw, Parameter{"raw", boolean, kInitial, "values are data, not colours", any, v3})
            .terse()
            .shown(", raw"),
        field(&T::gamma,
              Parameter{"gamma", number, "(of the file)", "1: linear, -1: sRGB", any, v0})
            .unwritten(),
        field(&T::channel,
              Parameter{"channel", string, "(all)", "r, g, b or a: use one as a number", any, v0})
            .unwritten()
            .read_by_plugin(),
        uv_field(&T::to_uv), field(&T::colors).shown(", colours "),
        field(&T::clamped).shown(", clamped"));
  }
  static constexpr const char* name() { return "bitmap"; }
  BitmapDecoding decoding() const {
    return {.raw = raw, .gamma = gamma, .channel = channel, .colors = colors, .clamped = clamped};
  }
  std::vector<std::string> losses() const;
  std::unique_ptr<Texture> build(SceneBuilder& b, const SourceLocation& where) const;
};

struct CheckerboardTexture {
  ColorInput color0 = Spectrum(0.4f), color1 = Spectrum(0.2f);
  /// Where a number is asked for (a roughness, an opacity), Mitsuba 3 exchanges the two colours;
  /// 0.x does not.
  bool swap_values = false;
  UvTransform to_uv;

  static constexpr auto fields() {
    using namespace parameter_words;
    using enum ParameterType;
    using T = CheckerboardTexture;
    return FieldList(field(&T::color0, Parameter{"color0", reflectance, kInitial}).shown(" "),
                     field(&T::color1, Parameter{"color1", reflectance, kInitial}).shown(" and "),
                     field(&T::swap_values), uv_field(&T::to_uv));
  }
  static constexpr const char* name() { return "checkerboard"; }
  std::unique_ptr<Texture> build(SceneBuilder& b, const SourceLocation& where) const;
};

struct MeshAttributeTexture {
  std::string attribute;
  double scale = 1;

  static constexpr auto fields() {
    using namespace parameter_words;
    using enum ParameterType;
    using T = MeshAttributeTexture;
    return FieldList(
        field(&T::attribute,
              Parameter{
                  .name = "name", .type = string, .note = "vertex_… or face_…", .required = true})
            .shown(" "),
        field(&T::scale, Parameter{"scale", number, kInitial}).terse());
  }
  static constexpr const char* name() { return "mesh_attribute"; }
  std::unique_ptr<Texture> build(SceneBuilder& b, const SourceLocation& where) const;
};

/// Unit squares of texture coordinates with lines that reach line_width into each.
struct GridLinesTexture {
  ColorInput color0 = Spectrum(0.2f), color1 = Spectrum(0.4f);
  double line_width = 0.01;
  UvTransform to_uv;

  static constexpr auto fields() {
    using namespace parameter_words;
    using enum ParameterType;
    using T = GridLinesTexture;
    return FieldList(
        field(&T::color0, Parameter{"color0", reflectance, kInitial, "of the fields"}).shown(" "),
        field(&T::color1, Parameter{"color1", reflectance, kInitial, "of the lines"})
            .shown(" and "),
        field(&T::line_width,
              Parameter{"line_width", number, kInitial, "into each field", not_negative}),
        uv_field_0x(&T::to_uv));
  }
  static constexpr const char* name() { return "gridtexture"; }
  static constexpr bool kAsksForColors = true;
  static constexpr bool kOnlyIn0x = true;
  std::unique_ptr<Texture> build(SceneBuilder& b, const SourceLocation& where) const;
};

/// The edges of triangles.
struct WireframeTexture {
  Spectrum interior{0.5f}, edge{0.1f};
  /// As far from an edge as it reaches; without: a tenth of a mesh's mean edge length.
  std::optional<double> line_width;
  /// The share of the line width, at its end, over which the colours change.
  double step_width = 0.5;

  static constexpr auto fields() {
    using namespace parameter_words;
    using enum ParameterType;
    using T = WireframeTexture;
    return FieldList(
        field(&T::interior, Parameter{"interior_color", unbounded, kInitial, "constant"})
            .shown(" "),
        field(&T::edge, Parameter{"edge_color", unbounded, kInitial, "constant"}).shown(" and "),
        field(&T::line_width, Parameter{"line_width", number, "0",
                                        "0: a tenth of a mesh's mean edge length", not_negative}),
        field(&T::step_width,
              Parameter{"step_width", number, kInitial,
                        "share of the line width over which the colours change; limited to 0 to "
                        "1"}));
  }
  static constexpr const char* name() { return "wireframe"; }
  static constexpr bool kOnlyIn0x = true;
  std::unique_ptr<Texture> build(SceneBuilder& b, const SourceLocation& where) const;
};

/// Curvature times a scale: positive red, negative blue.
struct CurvatureTexture {
  CurvatureKind shown = CurvatureKind::gaussian;
  double scale = 1;

  static constexpr std::string_view kKinds[] = {"gaussian", "mean"};
  static constexpr auto fields() {
    using namespace parameter_words;
    using enum ParameterType;
    using T = CurvatureTexture;
    return FieldList(
        field(&T::shown, Parameter{"curvature", string, kInitial, "gaussian or mean"})
            .words(kKinds),
        field(&T::scale, Parameter{.name = "scale",
                                   .type = number,
                                   .note = "of the curvature: red up to 1, blue down to -1",
                                   .range = not_negative,
                                   .required = true}));
  }
  static constexpr const char* name() { return "curvature"; }
  static constexpr bool kOnlyIn0x = true;
  std::unique_ptr<Texture> build(SceneBuilder& b, const SourceLocation& where) const;
};

/// Another texture times a colour.
struct ScaledTextureDescription {
  TextureId inner{};
  Spectrum scale{1.0f};

  static constexpr auto fields() {
    using namespace parameter_words;
    using enum ParameterType;
    using T = ScaledTextureDescription;
    return FieldList(field(&T::scale, Parameter{.name = "scale",
                                                .type = unbounded,
                                                .preset = kInitial,
                                                .note = "number or colour",
                                                .aliases = "value"}),
                     field(&T::inner));
  }
  static constexpr const char* name() { return "scale"; }
  static constexpr bool kOnlyIn0x = true;
  std::unique_ptr<Texture> build(SceneBuilder& b, const SourceLocation& where) const;
};

/// A volume, looked up in the world.
struct VolumeTextureDescription {
  std::variant<Spectrum, VolumeId> volume = Spectrum(0.75f);

  static constexpr auto fields() {
    using namespace parameter_words;
    using enum ParameterType;
    using T = VolumeTextureDescription;
    return FieldList(field(&T::volume, Parameter{"volume", albedo, kInitial}).shown(" "));
  }
  static constexpr const char* name() { return "volume"; }
  std::unique_ptr<Texture> build(SceneBuilder& b, const SourceLocation& where) const;
};

struct TextureDescription {
  SourceLocation where;
  Label label;
  std::variant<BitmapTexture, CheckerboardTexture, MeshAttributeTexture, GridLinesTexture,
               WireframeTexture, CurvatureTexture, ScaledTextureDescription,
               VolumeTextureDescription, NoiseTextureDescription, SolidCheckerboardDescription,
               MappedTextureDescription, MixDescription, ProductDescription,
               DirectionMixDescription, FunctionDescription, BilerpDescription, DotsDescription>
      model;
  static constexpr auto fields() {
    return plain_fields(&TextureDescription::where, &TextureDescription::label,
                        &TextureDescription::model);
  }
};

}  // namespace duet
