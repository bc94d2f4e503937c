// What a scene uses, in words: the contents of duet info, whatever form they are printed in.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "scene/description.h"

namespace duet {

struct NamedText {
  std::string name, text;
};

struct SceneParts {
  std::map<std::string, size_t> shape_kinds;  ///< how many shapes outside of groups there are
  std::vector<NamedText> bsdfs;               ///< of surfaces; what is nested is part of the text
  std::vector<NamedText> media;               ///< of shapes and sensors
  std::vector<std::string> lights;
};

SceneParts scene_parts(const SceneDescription& scene);

/// Why a method of integrator_names() cannot render the scene through its first sensor; empty if it
/// can.
std::string method_obstacle(const SceneDescription& scene, const std::string& method);

}  // namespace duet
