// How linear colours become what a display shows.
#pragma once

#include <optional>
#include <string_view>

#include "math/spectrum.h"

namespace duet {

enum class ToneCurve {
  srgb,      ///< as they are, cut off at 1
  aces,      ///< of film: the reference rendering of ACES for an sRGB display, fitted by S. Hill
  agx,       ///< of film, with bright colours that fade: T. Sobotka's AgX, fitted by B. Wrensch
  reinhard,  ///< by the luminance of the whole image (film_image.cpp)
};
inline constexpr std::string_view kToneCurveNames[] = {"srgb", "aces", "agx", "reinhard"};
std::optional<ToneCurve> tone_curve_of(std::string_view name);

/// What users ask for of files for display.
struct DisplaySettings {
  double exposure = 0;  ///< stops, on top of what the scene's film says
  bool automatic =
      false;  ///< the geometric mean of luminance becomes middle grey, 0.18, before that
  std::optional<ToneCurve> curve = {};  ///< instead of what the film says
  int png_depth = 8;                    ///< bits of a value in PNG files: 8 or 16
};

/// Display-encoded sRGB, each from 0 to 1, of linear sRGB, by a curve other than reinhard, which
/// has to be applied before and is srgb here. What is below zero is taken as zero. Sources: Hill,
/// ACES.hlsl of BakingLab (2017), RRTAndODTFit between two matrices; Wrensch, "Minimal AgX
/// Implementation" (2023), log2 encoding of 2^-12.47393 to 2^4.026069 and a polynomial of degree
/// six.
Spectrum displayed(const Spectrum& linear, ToneCurve curve);

}  // namespace duet
