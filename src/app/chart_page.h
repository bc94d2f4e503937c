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

/// The class attribute of a cell of line number `index` of `lines`, in a column in which
/// `contenders` may be the best; "" for the others, and for a line that is alone.
std::string best_mark(const std::vector<size_t>& contenders, size_t index, size_t lines);

}  // namespace duet
