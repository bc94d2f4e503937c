// Parameters that the readers of materials share.
#pragma once

#include "mitsuba/scene_reader.h"

namespace duet {

/// The roughness of an interface; zero becomes small, and what is negative is an error.
Roughness checked_roughness(SceneReader& s, Properties& p);
/// Index of the inside over that of the outside; an error for a rough interface without difference.
double relative_index(SceneReader& s, Properties& p);

}  // namespace duet
