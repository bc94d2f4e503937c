#include "evaluate/chart/colours.h"

#include <fmt/format.h>

#include <iterator>

namespace duet {

namespace {

constexpr ChartColour kSeries[] = {
    {"#0b6fb8", "#5cabe8"}, {"#d9541a", "#f08c56"}, {"#12906a", "#41c296"}, {"#a64ca6", "#d58cd5"},
    {"#b08400", "#dfb83c"}, {"#3a98cc", "#97d2f5"}, {"#6a51a3", "#ab9be8"}, {"#7a5230", "#c19671"}};

}  // namespace

std::string series_class(size_t index) {
  return fmt::format("series-{}", index % std::size(kSeries));
}

std::string chart_style() {
  std::string light, dark;
  for (size_t i = 0; i < std::size(kSeries); ++i) {
    light += fmt::format(".{} {{ color: {} }}\n", series_class(i), kSeries[i].light);
    dark += fmt::format(".{} {{ color: {} }}\n", series_class(i), kSeries[i].dark);
  }
  const auto rule = [&](const char* selector, const char* property, const ChartColour& colour) {
    dark += fmt::format("svg.chart{} {{ {}: {} }}\n", selector, property, colour.dark);
  };
  rule("", "fill", kInk);
  rule(" .paper", "fill", kPaper);
  rule(" .soft", "fill", kSoft);
  rule(" .grid", "stroke", kGrid);
  rule(" .frame", "stroke", kFrame);
  rule(" .guides", "stroke", kGuide);
  rule(" .guides", "fill", kGuide);
  rule(" .noise", "stroke", kNoise);
  rule(" .noise", "fill", kNoise);
  return light + "@media (prefers-color-scheme: dark) {\n" + dark + "}\n";
}

}  // namespace duet
