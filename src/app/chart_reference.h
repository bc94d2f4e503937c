// The reference of a chart: read from files, or rendered when there is none.
#pragma once

#include <optional>
#include <string>

#include "app/chart_options.h"
#include "app/chart_renderers.h"

namespace duet {

struct ChartReference {
  Image mean;
  std::optional<Image> variance;  ///< of the mean, per pixel
  std::string source;             ///< where it comes from and how it was made, in words
  std::string caveat;             ///< what may be wrong with it, or ""
};

/// Reads the reference of scene number `index`. Throws if a file cannot be used, or UsageError if
/// nobody says how many samples it has.
ChartReference read_reference(const ChartOptions& options, size_t index);

/// Renders a reference for this many seconds in independent parts, whose spread is its variance.
/// Empty if it was interrupted.
std::optional<ChartReference> make_reference(const ChartRender& render, Integrator& integrator,
                                             const std::string& name, double seconds);

/// Saves a reference that was made as reference.exr and reference-variance.exr, in the form in
/// which
/// --reference and --variance take them.
void save_reference(const ChartReference& reference, const std::string& directory);

}  // namespace duet
