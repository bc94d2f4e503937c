// Which media light sub-paths begin in.
#pragma once

#include "scene/scene.h"

namespace duet {

/// The medium that a ray from the camera is in when it has left the scene, or null.
const Medium* outermost_medium(const Scene& scene);

/// The medium at a point, or null: that on the near side of the nearest surface that separates
/// media, or Scene::outermost_medium where none is seen.
const Medium* medium_at(const Scene& scene, const Point3f& p);

/// The medium that a light sends its rays into. A surface that separates media says it itself, as
/// it does for light that is reflected. A light lies in one medium if no such surface reaches into
/// its bounding box.
LightMedium medium_before(const Scene& scene, const Light& light);

/// The medium, or null, at a point `p` just off the light from which a ray is emitted. Where the
/// light may lie in several, it is that on the near side of the first boundary on the way to
/// LightMedium::boundary_point: one ray, also right within boundaries that walls close.
const Medium* medium_at_emission(const Scene& scene, const LightMedium& light, const Point3f& p);

}  // namespace duet
