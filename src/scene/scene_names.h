// What the things in a scene are called.
#pragma once

#include <string>
#include <vector>

namespace duet {

struct SceneDescription;

/// By their indices in a Scene: their labels in its description.
struct SceneNames {
  std::vector<std::string> shapes, materials;
  /// "" of one without a label: what is seen in it has the names of the group's shapes.
  std::vector<std::string> instances;
};

/// Gives shapes and materials without a label one that is made of their place in the file:
/// "shape#3", "material#0". Instances have none then.
void name_unnamed(SceneDescription& description);

}  // namespace duet
