// Textures as plain data.
#pragma once

#include <optional>
#include <string>
#include <variant>

#include "math/transform.h"
#include "scene/description_base.h"
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
  bool operator==(const BitmapTexture&) const = default;
};

struct CheckerboardTexture {
  ColorInput color0 = Spectrum(0.4f), color1 = Spectrum(0.2f);
  /// Where a number is asked for (a roughness, an opacity), Mitsuba 3 exchanges the two colours;
  /// 0.x does not.
  bool swap_values = false;
  UvTransform to_uv;
  bool operator==(const CheckerboardTexture&) const = default;
};

struct MeshAttributeTexture {
  std::string attribute;
  double scale = 1;
  bool operator==(const MeshAttributeTexture&) const = default;
};

/// Unit squares of texture coordinates with lines that reach line_width into each.
struct GridLinesTexture {
  ColorInput color0 = Spectrum(0.2f), color1 = Spectrum(0.4f);
  double line_width = 0.01;
  UvTransform to_uv;
  bool operator==(const GridLinesTexture&) const = default;
};
/// The edges of triangles.
struct WireframeTexture {
  Spectrum interior{0.5f}, edge{0.1f};
  /// As far from an edge as it reaches; without: a tenth of a mesh's mean edge length.
  std::optional<double> line_width;
  /// The share of the line width, at its end, over which the colours change.
  double step_width = 0.5;
  bool operator==(const WireframeTexture&) const = default;
};
/// Curvature times a scale: positive red, negative blue.
struct CurvatureTexture {
  CurvatureKind shown = CurvatureKind::gaussian;
  double scale = 1;
  bool operator==(const CurvatureTexture&) const = default;
};
/// Another texture times a colour.
struct ScaledTextureDescription {
  TextureId inner{};
  Spectrum scale{1.0f};
  bool operator==(const ScaledTextureDescription&) const = default;
};
/// A volume, looked up in the world.
struct VolumeTextureDescription {
  std::variant<Spectrum, VolumeId> volume = Spectrum(0.75f);
  bool operator==(const VolumeTextureDescription&) const = default;
};

struct TextureDescription {
  SourceLocation where;
  Label label;
  std::variant<BitmapTexture, CheckerboardTexture, MeshAttributeTexture, GridLinesTexture,
               WireframeTexture, CurvatureTexture, ScaledTextureDescription,
               VolumeTextureDescription>
      model;
  bool operator==(const TextureDescription&) const = default;
};

}  // namespace duet
