// The parts of the vocabulary, one table for each kind of plugin but BSDFs; use vocabulary.h.
#pragma once

#include "mitsuba/vocabulary.h"

namespace duet::vocabulary {

using namespace parameter_words;

// vocabulary_shapes.cpp
std::span<const Plugin> shapes();
// vocabulary_lights.cpp
std::span<const Plugin> emitters();
// vocabulary_sensors.cpp
std::span<const Plugin> sensors();
std::span<const Plugin> films();
std::span<const Plugin> rfilters();
std::span<const Plugin> samplers();
// vocabulary_integrators.cpp
std::span<const Plugin> integrators();
std::span<const Plugin> scenes();
// vocabulary_media.cpp
std::span<const Plugin> media();
std::span<const Plugin> phases();
std::span<const Plugin> volumes();
std::span<const Plugin> subsurfaces();

/// The note of a transform that may change with time.
inline constexpr const char* kMovable = "in 0.x also an `<animation>`";

}  // namespace duet::vocabulary
