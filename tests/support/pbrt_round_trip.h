// From pbrt's text to a description, to text and to a description again.
#pragma once

#include <string>

#include "scene/description.h"

namespace duet::test {

/// Reads the text of a scene's world (or of a whole file), in a folder with "image.exr" and
/// "mesh.ply". There must be no message.
SceneDescription read_pbrt_text(const std::string& text, bool is_world = true);

/// Part by part, so that a failure says where the scenes differ. Values of grids may differ by
/// `tolerance` of their size.
void check_pbrt_parts(const SceneDescription& a, const SceneDescription& b, float tolerance = 0);

/// Writes what the world describes and reads it: without messages, it must be the same, and nothing
/// may be lost.
SceneDescription check_pbrt_round_trip(const std::string& world);

}  // namespace duet::test
