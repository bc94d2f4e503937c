// Textures as plain data.
#pragma once

#include <optional>
#include <string>
#include <variant>

#include "math/transform.h"
#include "scene/description_base.h"
#include "scene/field.h"
#include "textures/bitmap_options.h"
#include "textures/curvature_kind.h"

namespace duet {

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
  static constexpr auto fields() {
    return std::tuple_cat(
        std::tuple(field(&BitmapTexture::file).names_data()),
        plain_fields(&BitmapTexture::filter, &BitmapTexture::wrap_u, &BitmapTexture::wrap_v,
                     &BitmapTexture::raw, &BitmapTexture::gamma, &BitmapTexture::channel,
                     &BitmapTexture::to_uv));
  }
};

struct CheckerboardTexture {
  ColorInput color0 = Spectrum(0.4f), color1 = Spectrum(0.2f);
  /// Where a number is asked for (a roughness, an opacity), Mitsuba 3 exchanges the two colours;
  /// 0.x does not.
  bool swap_values = false;
  UvTransform to_uv;
  static constexpr auto fields() {
    return plain_fields(&CheckerboardTexture::color0, &CheckerboardTexture::color1,
                        &CheckerboardTexture::swap_values, &CheckerboardTexture::to_uv);
  }
};

struct MeshAttributeTexture {
  std::string attribute;
  double scale = 1;
  static constexpr auto fields() {
    return plain_fields(&MeshAttributeTexture::attribute, &MeshAttributeTexture::scale);
  }
};

/// Unit squares of texture coordinates with lines that reach line_width into each.
struct GridLinesTexture {
  ColorInput color0 = Spectrum(0.2f), color1 = Spectrum(0.4f);
  double line_width = 0.01;
  UvTransform to_uv;
  static constexpr auto fields() {
    return plain_fields(&GridLinesTexture::color0, &GridLinesTexture::color1,
                        &GridLinesTexture::line_width, &GridLinesTexture::to_uv);
  }
};
/// The edges of triangles.
struct WireframeTexture {
  Spectrum interior{0.5f}, edge{0.1f};
  /// As far from an edge as it reaches; without: a tenth of a mesh's mean edge length.
  std::optional<double> line_width;
  /// The share of the line width, at its end, over which the colours change.
  double step_width = 0.5;
  static constexpr auto fields() {
    return plain_fields(&WireframeTexture::interior, &WireframeTexture::edge,
                        &WireframeTexture::line_width, &WireframeTexture::step_width);
  }
};
/// Curvature times a scale: positive red, negative blue.
struct CurvatureTexture {
  CurvatureKind shown = CurvatureKind::gaussian;
  double scale = 1;
  static constexpr auto fields() {
    return plain_fields(&CurvatureTexture::shown, &CurvatureTexture::scale);
  }
};
/// Another texture times a colour.
struct ScaledTextureDescription {
  TextureId inner{};
  Spectrum scale{1.0f};
  static constexpr auto fields() {
    return plain_fields(&ScaledTextureDescription::inner, &ScaledTextureDescription::scale);
  }
};
/// A volume, looked up in the world.
struct VolumeTextureDescription {
  std::variant<Spectrum, VolumeId> volume = Spectrum(0.75f);
  static constexpr auto fields() { return plain_fields(&VolumeTextureDescription::volume); }
};

struct TextureDescription {
  SourceLocation where;
  Label label;
  std::variant<BitmapTexture, CheckerboardTexture, MeshAttributeTexture, GridLinesTexture,
               WireframeTexture, CurvatureTexture, ScaledTextureDescription,
               VolumeTextureDescription>
      model;
  static constexpr auto fields() {
    return plain_fields(&TextureDescription::where, &TextureDescription::label,
                        &TextureDescription::model);
  }
};

}  // namespace duet
