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
  std::string command_line;
  std::string scene_file;
  std::string scene_hash;
  std::string bias;  ///< what is known to be wrong with the method, or ""
  std::string integrator, integrator_parameters;
  std::optional<MethodDecision> decision;  ///< if the method has chosen another
  bool noise_only = false;                 ///< whether an estimate of the error leaves out a bias
  std::string sampler;
  uint64_t seed = 0;
  int threads = 1;
  RenderBudget requested;
};

using HeaderField = std::pair<std::string, HeaderValue>;
using HeaderFields = std::vector<HeaderField>;

// What an image says about itself: nothing of the machine or the user (provenance.h), and with
// SOURCE_DATE_EPOCH nothing that differs from run to run.

/// Of the scene and the method. `view` gives the matrices from the world to the camera and to the
/// image, in OpenEXR's convention: row vectors; the camera has x to the right, y up and z into the
/// scene, the image is the unit square with y downwards.
HeaderFields scene_header(const RenderRecord& record, const SensorDescription& view,
                          Point2i full_size);
/// Of the samples.
HeaderFields samples_header(const RenderRecord& record, const RenderResult& result);

/// Fields for files that hold texts and no layers: numbers as texts, no matrices.
TextFields header_texts(const HeaderFields& fields);

}  // namespace duet
