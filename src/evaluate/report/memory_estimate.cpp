#include "evaluate/report/memory_estimate.h"

#include <fmt/format.h>

#include <algorithm>

#include "integrators/error_estimate.h"

namespace duet {

namespace {

/// For what an allocator takes besides, and cannot use again.
constexpr double kSlack = 1.05;

/// Bytes for each pixel of images with the channels of a method.
struct PixelBytes {
  double sums;       ///< in doubles, while a film is developed (Film::develop)
  double image;      ///< in floats
  double converted;  ///< to the pixel format of the file, in floats
  double encoded;    ///< as a file; it grows by copying, and not everything can be compressed
};

PixelBytes pixel_bytes(const Integrator& integrator, bool half) {
  const double channels = double(integrator.channels().size());
  const double exact = half ? double(integrator.data_channels().size()) : channels;
  PixelBytes b;
  b.sums = (channels + 1) * sizeof(double);
  b.image = b.converted = channels * sizeof(float);
  b.encoded = 2 * (exact * sizeof(float) + (channels - exact) * sizeof(uint16_t));
  return b;
}

}  // namespace

MemoryEstimate estimate_memory(const Integrator& integrator, const FilmLayout& layout,
                               const RenderBudget& budget, bool half) {
  const std::vector<std::string> channels = integrator.channels();
  const double pixels = double(layout.crop.width()) * layout.crop.height();
  // How many layers of splats there are, and whether of moments, a film of one pixel tells, too.
  Film small({{1, 1}, {0, 0, 1, 1}, layout.filter}, channels);
  integrator.prepare(small);
  const double tiles = Film::tile_bytes(layout, channels.size());
  const double film = tiles + small.layer_bytes(layout);
  const int films = budget.target_error ? kErrorBatches : 1;

  const PixelBytes b = pixel_bytes(integrator, half);
  const double developing = pixels * (b.sums + b.image);
  const double writing = pixels * (b.image + b.converted + b.encoded);
  MemoryEstimate e;
  e.films = films * film;
  e.method = integrator.memory_bytes(layout);
  if (budget.target_error) {
    // All films are developed to compare them (batch_relative_rmse).
    const double comparing = pixels * (b.sums + films * b.image);
    e.copies = std::max(comparing, writing);
  } else {
    e.copies = PartialMeans::memory_bytes(pixels, small.splat_layer_count() > 0) +
               std::max(developing, writing);
  }
  e.films *= kSlack, e.copies *= kSlack;
  return e;
}

std::string describe(const MemoryEstimate& e) {
  return fmt::format(
      "the image needs about {} of memory ({} for sums of samples, {} for light sub-paths, {} for "
      "copies)",
      memory_text(e.total()), memory_text(e.films), memory_text(e.method), memory_text(e.copies));
}

std::string memory_refusal(const MemoryEstimate& e, double in_use, const MemoryLimit& limit) {
  if (in_use + e.total() <= limit.bytes) return "";
  return fmt::format("{} beside the {} in use; the limit is {} ({})", describe(e),
                     memory_text(in_use), memory_text(limit.bytes), limit.source);
}

}  // namespace duet
