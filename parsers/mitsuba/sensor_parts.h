// What the readers of sensors share.
#pragma once

#include "mitsuba/scene_reader.h"

namespace duet {

/// What all sensors have: place, clipping planes, medium, film and sampler.
void read_sensor(SceneReader& s, Properties& p, SensorDescription& out);
/// An error if the transform, at any time, does more than turn, mirror and move: cameras have no
/// size.
void check_rigid(Properties& p, const SensorDescription& sensor);

}  // namespace duet
