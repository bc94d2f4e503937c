// What users ask for of the files that an image is written to, besides what its film says.
#pragma once

#include "evaluate/report/aov_names.h"
#include "image/tone_curve.h"

namespace duet {

struct FileSettings {
  DisplaySettings display = {};  ///< of files for display
  AovNames aov_names = AovNames::duet;
  bool exr_parts = false;  ///< whether each layer is a part of its own in EXR files
};

}  // namespace duet
