// The reference of a chart: read from files, or rendered when there is none.
#pragma once

#include <optional>
#include <string>

#include "evaluate/chart/renderers.h"

namespace duet {

struct ChartReference {
  Image mean;
  std::optional<Image> variance;  ///< of the mean, per pixel
  std::string source;             ///< where it comes from and how it was made, in words
  std::string caveat;             ///< what may be wrong with it, or ""
};

/// Reads a reference and, unless "", the variance of one sample of it. `spp` are its samples per
/// pixel, or 0 if its header says that. Throws if a file cannot be used, and UnknownSamples.
ChartReference read_reference(const std::string& path, const std::string& variance, double spp);

/// Renders a reference for this many seconds in independent parts, whose spread is its variance.
/// Empty if it was interrupted.
std::optional<ChartReference> make_reference(const ChartRender& render, Integrator& integrator,
                                             const std::string& name, double seconds);

/// Saves a reference that was made as reference.exr and reference-variance.exr, in the form in
/// which `duet chart --reference --variance` takes them.
void save_reference(const ChartReference& reference, const std::string& directory,
                    const std::string& command_line);

}  // namespace duet
