// The pages of `duet chart`: each one HTML file that opens from disk and needs nothing else.
#pragma once

#include <string>
#include <vector>

#include "app/chart_data.h"

namespace duet {

/// Charts, images, table and notes of one scene.
std::string chart_page(const ChartScene& scene);
/// The table of all scenes, with links to `NAME/index.html` and their charts.
std::string chart_index(const std::vector<ChartScene>& scenes);

}  // namespace duet
