// The colours of charts, on light paper and on dark.
#pragma once

#include <cstddef>
#include <string>

namespace duet {

/// The same role on light and on dark paper, as "#rrggbb".
struct ChartColour {
  const char* light;
  const char* dark;
};

inline constexpr ChartColour kPaper{"#ffffff", "#1e2226"}, kInk{"#1d2126", "#e6e8ea"},
    kSoft{"#667078", "#98a2aa"}, kGrid{"#e4e7ea", "#30363c"}, kFrame{"#b9c0c6", "#59626a"},
    kGuide{"#7d868e", "#89939b"}, kNoise{"#8a6d33", "#cdb277"};

/// The class of what belongs to line number `index`: its text colour (`currentColor`) is that of
/// the line wherever chart_style() is on the page.
std::string series_class(size_t index);

/// Style rules for charts. The light colours are attributes in the SVG, too, for programs that know
/// no media queries; the dark ones are here alone.
std::string chart_style();

}  // namespace duet
