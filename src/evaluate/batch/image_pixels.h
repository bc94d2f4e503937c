// How many pixels a job has, as far as that can be told without reading its scene as a whole.
#pragma once

#include <optional>

#include "evaluate/batch/job.h"

namespace duet::batch {

/// From --size, --crop or the film of the scene file. No meshes, textures or volumes are read, and
/// of pbrt's files nothing beyond WorldBegin. Nothing if the file cannot be understood. It decides
/// how many threads a job gets, never what it renders.
std::optional<double> image_pixels(const Job& job);

}  // namespace duet::batch
