// The figures of `duet compare`, what can be required of them, and the verdict.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "image/display_metrics.h"
#include "image/flip.h"
#include "image/metrics.h"
#include "image/percentage_errors.h"
#include "image/tile_test.h"

namespace duet {

/// All that is measured of one image, or of a set of them.
struct Measurements {
  ImageMetrics metrics;
  DisplayMetrics display;
  PercentageErrors percentage;
  std::optional<double> flip, hdr_flip;
  std::optional<TileComparison> tiles;
};

/// A number that --require can test.
struct Figure {
  std::string name;
  std::optional<double> value;  ///< empty if it is not available
  std::string formula;
  /// The option without which it is not available, or "".
  std::string needs;
};
std::vector<Figure> figures(const Measurements& measurements);

/// One --require, such as "rmse<0.02".
struct Requirement {
  std::string text, figure;
  bool less = true;
  double limit = 0;
};
/// Throws UsageError for what is not like that or names no figure.
Requirement parse_requirement(const std::string& text);
/// Those that are missed; a figure that is not a number or not available misses every limit.
std::vector<Requirement> missed_of(const std::vector<Requirement>& requirements,
                                   const Measurements& measurements);

enum class Verdict { pass, noisy, biased, fail };
const char* name_of(Verdict verdict);
Verdict judge(const Measurements& measurements, const std::vector<Requirement>& missed);

/// The help on figures and verdicts.
std::string figures_help();

}  // namespace duet
