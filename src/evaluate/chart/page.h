// The pages of `duet chart`: each one HTML file that opens from disk and needs nothing else.
#pragma once

#include <string>
#include <vector>

#include "evaluate/chart/data.h"

namespace duet {

/// Charts, images, table and notes of one scene; mentions the command that made them.
std::string chart_page(const ChartScene& scene, const std::string& command_line);
/// The page with its charts and its table as files of their own, in a folder that is there.
void write_chart(const ChartScene& scene, const std::string& folder,
                 const std::string& command_line);
/// The table of all scenes, with links to `NAME/index.html` and their charts; likewise.
std::string chart_index(const std::vector<ChartScene>& scenes, const std::string& command_line);
/// This page and its table as files of their own, in a folder that is there. The page's path.
std::string write_chart_index(const std::vector<ChartScene>& scenes, const std::string& folder,
                              const std::string& command_line);

/// The class attribute of a cell of line number `index` of `lines`, in a column in which
/// `contenders` may be the best; "" for the others, and for a line that is alone.
std::string best_mark(const std::vector<size_t>& contenders, size_t index, size_t lines);

}  // namespace duet
