// Charts of error against cost on logarithmic axes, as SVG.
#pragma once

#include <string>

#include "app/chart_data.h"

namespace duet {

/// What the horizontal axis shows.
enum class ChartAxis { cpu_seconds, spp };

/// A complete SVG document. Every line is a <g class="line"> with a band (its 95 % interval), a
/// polyline and a marker for each point; its colour is that of chart_colour().
std::string chart_svg(const ChartScene& scene, ChartAxis axis);

/// The colour of line number `index`, as "#rrggbb".
std::string chart_colour(size_t index);

}  // namespace duet
