// Which media walks from lights begin in.
#pragma once

#include "scene/scene.h"

namespace duet {

/// The medium that a ray from the camera is in when it has left the scene, or null.
const Medium* outermost_medium(const Scene& scene);

/// The medium at a point, or null: that on the near side of the nearest surface that separates
/// media, or `outermost` where none is seen.
const Medium* medium_at(const Scene& scene, const Point3f& p, const Medium* outermost);

/// The medium that a light sends its rays into, or null. A surface that separates media says it
/// itself, as it does for light that is reflected.
const Medium* medium_before(const Scene& scene, const Light& light, const Medium* outermost);

}  // namespace duet
