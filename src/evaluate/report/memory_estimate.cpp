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
  double sums;   ///< in doubles, while a film is developed (Film::develop), if all rows are at once
  double image;  ///< in floats
  double converted;  ///< to the pixel format of the file, in floats
  double encoded;    ///< as a file; it grows by copying, and not everything can be compressed
};

PixelBytes pixel_bytes(size_t all_channels, size_t data_channels, bool half) {
  const double channels = double(all_channels);
  const double exact = half ? double(data_channels) : channels;
  PixelBytes b;
  b.sums = (channels + 1) * sizeof(double);
  b.image = b.converted = channels * sizeof(float);
  b.encoded = 2 * (exact * sizeof(float) + (channels - exact) * sizeof(uint16_t));
  return b;
}

}  // namespace

MemoryEstimate estimate_memory(const FilmContents& contents, size_t data_channels,
                               const FilmLayout& layout, size_t films, bool half) {
  const size_t channels = contents.channels.size();
  const double pixels = double(layout.crop.width()) * layout.crop.height();
  const Film small({{1, 1}, {0, 0, 1, 1}, layout.filter}, contents);
  const double film = Film::tile_bytes(layout, channels) + small.layer_bytes(layout);
  const PixelBytes b = pixel_bytes(channels, data_channels, half);
  const double developing = pixels * (b.sums + b.image);
  const double writing = pixels * (b.image + b.converted + b.encoded);
  MemoryEstimate e;
  e.films = kSlack * double(films) * film;
  if (films > 1) {
    // All films are developed to compare them (batch_relative_rmse).
    const double comparing = pixels * (b.sums + double(films) * b.image);
    e.copies = kSlack * std::max(comparing, writing);
  } else {
    e.copies = kSlack * (PartialMeans::memory_bytes(pixels, !contents.splats.empty()) +
                         std::max(developing, writing));
  }
  return e;
}

MemoryEstimate estimate_memory(const Integrator& integrator, const FilmLayout& layout,
                               const RenderBudget& budget, bool half) {
  // What is gathered, a film of one pixel tells, too.
  Film small({{1, 1}, {0, 0, 1, 1}, layout.filter}, integrator.channels());
  integrator.prepare(small);
  MemoryEstimate e = estimate_memory(small.contents(), integrator.data_channels().size(), layout,
                                     budget.target_error ? kErrorBatches : 1, half);
  e.method = integrator.memory_bytes(layout);
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
