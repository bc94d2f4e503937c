// The scenes in a folder and those below it.
#pragma once

#include <string>
#include <vector>

#include "evaluate/batch/job.h"

namespace duet::batch {

/// A job for each scene file, ordered by name: Mitsuba's .xml files with a sensor, in themselves or
/// in what they include, and pbrt's .pbrt and .pbrt.gz files with a WorldBegin. What other scene
/// files include is a part of them; a file that begins like a scene and cannot be read is a job
/// that will say why. Symbolic links to folders are not followed. That there is no scene, or that a
/// folder cannot be read, is an error.
std::vector<Job> scenes_below(const std::string& folder, Diagnostics& diagnostics);

}  // namespace duet::batch
