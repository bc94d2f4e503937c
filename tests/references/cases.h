// The reference images, and the scenes that are rendered to compare with them.
#pragma once

#include <cstdlib>

#include "image/image_io.h"
#include "image/metrics.h"
#include "references/rendering.h"
#include "support/image_header.h"

namespace duet::test {

/// A scene and the reference it is held against.
struct ReferenceCase {
  std::string reference, scene;
  Defines defines;
  int spp;
  /// Twice what was measured when the case was written.
  double relative_rmse;
  double z_share = kRequiredZShare;
  /// Mitsuba is off in a part of the image by more than the noise (docs/compatibility.md).
  bool differs = false;
};

/// For scenes with paths so rare and bright that the spread of the reference's passes has missed
/// them in some pixels: there no number of samples makes the differences normal.
inline constexpr double kHeavyTails = 0.992;

inline const std::vector<ReferenceCase>& reference_cases() {
  static const std::vector<ReferenceCase> cases{
      {"batch", "batch", {}, 256, 0.013},
      {"bsdf-conductors", "bsdf-conductors", {}, 256, 0.06},
      {"bsdf-dielectrics", "bsdf-dielectrics", {}, 256, 0.11},
      {"bsdf-fibres", "bsdf-fibres", {}, 256, 0.2},
      {"bsdf-measured", "bsdf-measured", {}, 256, 0.2},
      {"bsdf-plastics", "bsdf-plastics", {}, 256, 0.066},
      {"bsdf-principled", "bsdf-principled", {}, 1024, 0.08, kHeavyTails},
      {"bsdf-wrappers", "bsdf-wrappers", {}, 1024, 0.05, kHeavyTails, true},
      {"camera", "camera", {}, 256, 0.01},
      {"cornell-box", "cornell-box", {{"size", "128"}}, 512, 0.05},
      {"curves", "curves", {}, 256, 0.2},
      {"depth-of-field", "depth-of-field", {}, 256, 0.017},
      {"directional-area", "directional-area", {}, 256, 0.16},
      {"environment-map", "environment-map", {}, 256, 0.062},
      {"filters-tent", "filters", {{"filter", "tent"}}, 256, 0.016},
      {"filters-gaussian", "filters", {{"filter", "gaussian"}}, 256, 0.014},
      {"filters-mitchell", "filters", {{"filter", "mitchell"}}, 256, 0.017},
      {"filters-catmullrom", "filters", {{"filter", "catmullrom"}}, 256, 0.02},
      {"filters-lanczos", "filters", {{"filter", "lanczos"}}, 256, 0.022},
      {"hide-behind", "hide-behind", {}, 256, 0.05},
      {"hide-emitters", "hide-emitters", {}, 256, 0.022},
      {"instances", "instances", {}, 256, 0.07},
      {"lights-area", "lights-area", {}, 256, 0.07},
      {"lights-delta", "lights-delta", {}, 256, 0.19},
      {"lights-placed", "lights-placed", {}, 256, 0.27, kHeavyTails},
      {"media-boundaries", "media-boundaries", {}, 256, 0.1},
      {"media-heterogeneous", "media-heterogeneous", {}, 256, 0.043},
      {"media-homogeneous", "media-homogeneous", {}, 256, 0.37, 0.985},
      {"media-nested", "media-nested", {}, 256, 0.1, kHeavyTails},
      {"media-phase", "media-phase", {}, 512, 0.083},
      {"mesh-lumpy", "mesh-lumpy", {{"size", "128"}}, 256, 0.05},
      {"orthographic", "orthographic", {}, 256, 0.023},
      {"sdf-grid", "sdf-grid", {}, 256, 0.06},
      {"shapes", "shapes", {}, 256, 0.011},
      {"shapes-files", "shapes-files", {}, 256, 0.038},
      {"spectra", "spectra", {}, 256, 0.018},
      {"sunsky", "sunsky", {}, 256, 0.056},
      {"texture-slots", "texture-slots", {}, 256, 0.1},
      {"textures", "textures", {}, 256, 0.01},
      {"thesis-empty", "thesis-empty", {{"size", "128"}}, 1024, 0.035},
      {"thesis-modified", "thesis-modified", {{"size", "128"}}, 1024, 0.2},
      {"two-versions", "two-versions", {}, 256, 0.021},
  };
  return cases;
}

/// A folder of reference/.
struct Reference {
  explicit Reference(const std::string& name) {
    const std::string folder = source_path("reference/" + name);
    const ImageFile file = read_image(folder + "/mean.exr");
    mean = file.image;
    variance = read_image(folder + "/variance.exr").image;
    spp = std::atof(header_field(file, "spp").c_str());
    REQUIRE(spp > 0);
  }
  Image mean;
  Image variance;  ///< of one sample
  double spp = 0;
};

}  // namespace duet::test
