// Writes a scene description as a pbrt-v4 scene file.
#pragma once

#include <string>
#include <vector>

#include "scene/description.h"

namespace duet::pbrt {

struct PbrtText {
  std::string text;
  /// What pbrt cannot express, one sentence each. The text lists it in comments, together with the
  /// description's approximations.
  std::vector<std::string> losses;
};

/// Files are named as the description names them; meshes are PLY files if MeshSource::pbrt_file
/// names one, and otherwise stand in the text, as grids do. pbrt measures colours in the space of
/// its film, which is linear sRGB here.
PbrtText write_pbrt(const SceneDescription& description);

}  // namespace duet::pbrt
