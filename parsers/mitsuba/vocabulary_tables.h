// The parts of the vocabulary, one table for each kind of plugin but BSDFs; use vocabulary.h.
#pragma once

#include "mitsuba/vocabulary.h"

namespace duet::vocabulary {

using namespace parameter_words;

// vocabulary_shapes.cpp
std::span<const Plugin> shapes();
// vocabulary_sensors.cpp
std::span<const Plugin> sensors();
std::span<const Plugin> films();
std::span<const Plugin> rfilters();
std::span<const Plugin> samplers();
}  // namespace duet::vocabulary
