// Fields of view as sensors and projectors state them: by angle or by focal length.
#pragma once

#include <utility>

#include "math/fov.h"
#include "mitsuba/properties.h"

namespace duet {

/// The diagonal field of view, in degrees, of a lens of that many millimetres before 36 mm × 24 mm
/// film.
double diagonal_fov(double focal_length);

/// From the parameters `fov` and `fov_axis`, or `focal_length`.
std::pair<double, FovAxis> read_fov(Properties& p);

}  // namespace duet
