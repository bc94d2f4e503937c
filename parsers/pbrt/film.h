// The film of a pbrt scene and its filter.
#pragma once

#include "pbrt/reader.h"

namespace duet::pbrt {

/// What Film and PixelFilter say. The shutter is open for `exposure_time` seconds.
void read_film(Reader& reader, SensorDescription& sensor, double exposure_time);

}  // namespace duet::pbrt
