// What a render of a scene takes in memory, estimated from its description.
#pragma once

#include <string>

#include "scene/description.h"

namespace duet {

/// Bytes, the most that there is at one time.
struct SceneMemory {
  double description = 0;  ///< what the program has in use when it has read the scene
  double geometry = 0;     ///< what is built from shapes, and is needed to build it
  double images = 0;       ///< texels of textures and environment maps, and to read them
  double film = 0;         ///< the image, the method, and for each thread

  double total() const { return description + geometry + images + film; }
};

/// Of the image of the first sensor by the scene's method; if that is chosen when rendering, by the
/// one that takes the most. Images are asked for their size alone. Of files whose size is not known
/// that way (all but EXR, PNG and JPEG), texels are taken for four times the file. Not counted is
/// what displacement adds to meshes. Reads how much the program has in use.
SceneMemory estimate_scene_memory(const SceneDescription& scene);

/// For people: "about 1.2 GB: 12 MB the description, …".
std::string describe(const SceneMemory& memory);

}  // namespace duet
