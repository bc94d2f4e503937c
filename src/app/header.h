// What an image file says about how it was made.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "image/image_io.h"
#include "integrators/pass.h"
#include "scene/description.h"

namespace duet {

/// All facts about one finished render.
struct RenderRecord {
  std::string scene_file;
  uint64_t scene_hash = 0;
  std::string bias;  ///< what is known to be wrong with the method, or ""
  std::string integrator, integrator_parameters;
  std::optional<MethodDecision> decision;  ///< if the method has chosen another
  bool noise_only = false;                 ///< whether an estimate of the error leaves out a bias
  std::string sampler;
  uint64_t seed = 0;
  int threads = 1;
};

/// Fields of the EXR header. `view` gives the matrices from the world to the camera and to the
/// image, in OpenEXR's convention: row vectors; the camera has x to the right, y up and z into the
/// scene, the image is the unit square with y downwards.
std::vector<std::pair<std::string, HeaderValue>> image_header(const RenderRecord& record,
                                                              const RenderResult& result,
                                                              const SensorDescription& view,
                                                              Point2i full_size);

/// A 64-bit fingerprint of the bytes of a file or of kStandardInput; 0 if it cannot be read.
uint64_t hash_file(const std::string& path);

}  // namespace duet
