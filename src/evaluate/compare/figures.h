// The figures of `duet compare`, what can be required of them, and the verdict.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "image/bias_test.h"
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
  std::optional<BiasTest> bias_test;
  /// The p-value of the test that tells bias from noise, with --variance or --batches; empty also
  /// if no pixel could be tested.
  std::optional<double> p_value() const;
};

/// A number that can be required to be below or above a limit.
struct Figure {
  std::string name;
  std::optional<double> value;  ///< empty if it is not available
  std::string formula;
  /// The option without which it is not available, or "".
  std::string needs;
};
std::vector<Figure> figures(const Measurements& measurements);

/// A limit of a figure, such as "rmse<0.02".
struct Requirement {
  std::string text, figure;
  bool less = true;
  double limit = 0;
};
/// They as they were written.
std::vector<std::string> texts_of(const std::vector<Requirement>& requirements);
/// Those that are missed; a figure that is not a number or not available misses every limit.
std::vector<Requirement> missed_of(const std::vector<Requirement>& requirements,
                                   const Measurements& measurements);

/// Without a requirement there is nothing to pass: the verdict is `none` if no bias is found.
enum class Verdict { pass, none, noisy, biased, fail };
const char* name_of(Verdict verdict);
/// Only a test with a known rate of false alarms makes the verdict BIASED (docs/compare.md).
Verdict judge(const Measurements& measurements, const std::vector<Requirement>& requirements,
              const std::vector<Requirement>& missed);

/// The help on figures and verdicts.
std::string figures_help();

}  // namespace duet
