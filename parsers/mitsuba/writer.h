// Writes a scene description as a Mitsuba 3 scene file.
#pragma once

#include <string>
#include <vector>

#include "scene/description.h"

namespace duet {

struct MitsubaXml {
  std::string text;
  /// What Mitsuba 3 cannot express, one sentence each: it is missing, except for integrators, which
  /// are written as only Duet reads them. The text lists it in a comment, together with the
  /// description's approximations.
  std::vector<std::string> losses;
};

/// Mitsuba 3.9 can load the text, unless the integrator is one of Duet's own. Read again, it yields
/// an equal description, except for what is missing. Meshes and images are named by their absolute
/// paths.
MitsubaXml write_mitsuba_xml(const SceneDescription& description);

}  // namespace duet
