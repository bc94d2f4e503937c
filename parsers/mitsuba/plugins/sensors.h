// What the files about sensors share.
#pragma once

#include "mitsuba/scene_reader.h"

namespace duet::plugins {

/// Sensors that measure, and the batch of sensors (sensor_meters.cpp); `response` is the parameter
/// that they refuse.
std::vector<Plugin> meters(const Parameter& response);

/// What all sensors have: place, clipping planes, medium, film and sampler.
void read_sensor(SceneReader& s, Properties& p, SensorDescription& out);

}  // namespace duet::plugins
