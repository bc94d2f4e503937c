// Charts of error against cost on logarithmic axes, as SVG.
#pragma once

#include <string>

#include "evaluate/chart/data.h"

namespace duet {

/// What the horizontal axis shows.
enum class ChartAxis { cpu_seconds, spp };

/// A complete SVG document. Every line is a <g class="line"> with a band (its 95 % interval), a
/// polyline and a marker for each point, in the colours of app/chart_colours.h.
std::string chart_svg(const ChartScene& scene, ChartAxis axis);

}  // namespace duet
