// Error against time of several methods.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <duet/scene_file.h>

namespace duet {

/// A method to compare.
struct ChartedMethod {
  std::string integrator;                                       ///< "path", "bdpt", "vcm" …
  std::vector<std::pair<std::string, std::string>> parameters;  ///< of the method
  std::string name;  ///< on the chart; "" stands for the integrator's
};

/// What `duet chart` can be told, with the same meaning.
struct ChartSettings {
  std::vector<ChartedMethod> methods;
  double seconds = 60;  ///< wall time, which the methods share equally
  /// The file of the image that is right. Without it one is made in half the time, by `bdpt` if
  /// that is among the methods, else by the first one without bias.
  std::string reference;
  /// The file of the variance of one sample of the reference, which is subtracted from errors.
  std::string reference_variance;
  double reference_spp = 0;  ///< samples per pixel of the reference; 0: as its header says
  std::optional<std::array<int, 2>> size;  ///< width and height; else the reference's or scene's
  size_t sensor = 0;
  uint64_t seed = 1000;  ///< another than that of the reference
  int threads = 0;       ///< as in RenderSettings
};

/// A method's image at one moment. Errors are squared and relative (but for `mse`), with the
/// variance of the reference subtracted, so they can come out below zero (docs/figures.md).
struct ChartedPoint {
  double seconds = 0;      ///< wall time of this method alone
  double cpu_seconds = 0;  ///< of all threads together
  int spp = 0;             ///< samples per pixel
  double mse = 0, relmse = 0;
  double trimmed = 0;    ///< relmse without the worst thousandth of the pixels
  double fireflies = 0;  ///< share of the light that is in the brightest thousandth of the pixels
};

/// A number with its interval of 95 %.
struct ChartedEstimate {
  double value = 0, low = 0, high = 0;
};

/// A method's way through its share of the time.
struct ChartedLine {
  std::string name, parameters;
  std::string bias;     ///< what is known to be wrong with it, or ""
  std::string failure;  ///< why it ended early, or ""
  std::vector<ChartedPoint> points;
  std::optional<ChartedEstimate> slope;       ///< of log error over log CPU seconds
  std::optional<ChartedEstimate> efficiency;  ///< 1 / (trimmed · CPU seconds), at the last point
};

/// What came of a chart. It never changes; copies share what is behind them.
class [[gnu::visibility("default")]] MethodChart {
 public:
  const std::vector<ChartedLine>& lines() const;
  /// What a reader should know.
  const std::vector<std::string>& notes() const;
  int width() const;
  int height() const;
  /// Where the reference comes from, in words.
  const std::string& reference() const;
  /// The chart.csv of `duet chart`, its chart.svg over CPU seconds, and over samples per pixel.
  std::string csv() const;
  std::string svg() const;
  std::string svg_of_samples() const;
  /// The index.html of `duet chart`: one file that opens from disk and needs nothing else.
  /// `how_made` is shown as the command that made it.
  std::string page(const std::string& how_made) const;

  /// The library's own.
  struct Contents;
  explicit MethodChart(std::shared_ptr<const Contents> contents) : contents_(std::move(contents)) {}

 private:
  std::shared_ptr<const Contents> contents_;
};

/// How a chart is watched and stopped.
struct ChartWatch {
  std::function<void(const std::string&)> info = {}, warning = {};  ///< from the calling thread
  const std::atomic<bool>* cancel = nullptr;                        ///< to be set by any thread
};

/// Renders the scene with all methods, which take turns in short slices, until the time is used up
/// or it is cancelled; nothing if that was before there was a reference. Writes no file. Throws
/// SceneError for what a method cannot render, FileError for a reference that cannot be read,
/// std::invalid_argument for settings that make no sense, std::out_of_range, and std::runtime_error
/// if the image is too small for a chart or has another shape than the reference.
[[gnu::visibility("default")]] std::optional<MethodChart> chart_file(const SceneFile& scene,
                                                                     const ChartSettings& settings,
                                                                     const ChartWatch& watch = {});

}  // namespace duet
