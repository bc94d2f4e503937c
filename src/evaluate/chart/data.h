// What `duet chart` measures of a scene, for the files that show it.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "image/image.h"
#include "math/contenders.h"
#include "math/slope.h"

namespace duet {

/// The state of a render at one moment.
struct ChartPoint {
  double seconds = 0;      ///< by the clock on the wall, of this method alone
  double cpu_seconds = 0;  ///< of all threads together
  int spp = 0;
  /// Squared errors with the reference's variance subtracted; they can come out below zero.
  double mse = 0, relmse = 0, trimmed = 0;
  double firefly = 0;
  std::vector<double> tile_sums, tile_pixels;
};

/// One method's way through its share of the time.
struct ChartLine {
  std::string name;        ///< as it was asked for
  std::string parameters;  ///< all of them
  std::string bias;        ///< what is known to be wrong with it, or ""
  std::string failure;     ///< why it ended early, or ""
  bool external = false;
  std::vector<ChartPoint> points;
  Image image;  ///< at the last point
  CurveFit by_time, by_spp;
};

/// All about one scene.
struct ChartScene {
  std::string name, file;
  int width = 0, height = 0, threads = 1;
  double seconds = 0;            ///< the budget
  std::string reference_source;  ///< where the reference comes from, in words
  std::string reference_caveat;  ///< what may be wrong with it, or ""
  double reference_noise = 0;    ///< its relMSE, trimmed
  Image reference;
  std::vector<ChartLine> lines;
  std::vector<std::string> notes;  ///< what a reader of the chart should know
};

/// Fits the curves of a line from its points.
void fit(ChartLine& line);

/// 1 / (trimmed relMSE · CPU seconds) at the last point, with its interval; empty if the error is
/// not above zero.
std::optional<Estimate> efficiency(const ChartLine& line);
/// The largest efficiency of the lines, or 0.
double best_efficiency(const ChartScene& scene);
/// The numbers of the lines that may be the most efficient ones (see contenders()). One whose error
/// is not above zero has an interval without an upper end.
std::vector<size_t> most_efficient(const ChartScene& scene);

/// CPU seconds until the root of the trimmed relMSE is this small: between two points on a straight
/// line on logarithmic axes, beyond the last one by the fitted slope. The first point may be better
/// already. The interval is where the intervals of the curve, and of its slope, reach that error.
struct TimeToError {
  double cpu_seconds = 0;
  enum Kind { interpolated, at_most, extrapolated } kind = interpolated;
  Interval interval_95;
};
std::optional<TimeToError> time_to_error(const ChartLine& line, double root_trimmed);
/// The numbers of the lines that may be the first to have this error.
std::vector<size_t> fastest(const ChartScene& scene, double root_trimmed);
/// Three round errors (1, 2 or 5 times a power of ten) that the best line of the scene reaches, the
/// largest first and the last one just so.
std::vector<double> round_errors(const ChartScene& scene);

/// What came of a line, in one line for people.
std::string line_summary(const ChartScene& scene, const ChartLine& line);

/// The tables as CSV, with a line of names.
std::string chart_csv(const ChartScene& scene);
std::string summary_csv(const std::vector<ChartScene>& scenes);

}  // namespace duet
