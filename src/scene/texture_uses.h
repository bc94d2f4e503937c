// Whether textures are asked for colours or for numbers: a checkerboard of Mitsuba 3 exchanges its
// colours when it is asked for a number.
#pragma once

#include <vector>

#include "scene/description.h"

namespace duet {

struct TextureUse {
  bool as_color = false, as_number = false;
};

/// What each texture of the scene is asked for, also through other textures.
std::vector<TextureUse> texture_uses(const SceneDescription& scene);
/// The same, where materials that no shape has ask for nothing.
std::vector<TextureUse> texture_uses_of_shapes(const SceneDescription& scene);

/// Gives checkerboards of the same meaning the same form: their values are exchanged only if they
/// are asked for colours as well as for numbers. One that yields numbers alone gets its colours
/// exchanged instead.
void settle_checkerboards(SceneDescription& scene);

}  // namespace duet
