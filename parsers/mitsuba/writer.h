// Writes a scene description as a Mitsuba 3 scene file.
#pragma once

#include <string>
#include <vector>

#include "scene/description.h"

namespace duet {

struct MitsubaXml {
  std::string text;
  /// What Mitsuba 3 cannot express and is therefore missing, one sentence each. The text lists it
  /// in a comment, together with the description's approximations.
  std::vector<std::string> losses;
};

/// Mitsuba 3.9 can load the text. Read again, it yields an equal description, except for the
/// losses. Meshes and images are named by their absolute paths.
MitsubaXml write_mitsuba_xml(const SceneDescription& description);

}  // namespace duet
