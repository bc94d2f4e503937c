// The loop over pixels and samples that all methods which start at the camera share.
#pragma once

#include <array>
#include <cmath>
#include <span>

#include "integrators/integrator.h"

namespace duet {

/// Dimensions of the sampler: two for the film, two for the lens, then a block for each vertex.
inline constexpr uint32_t kFilmDimension = 0;
inline constexpr uint32_t kLensDimension = 2;
inline constexpr uint32_t kFirstVertexDimension = 4;
inline constexpr int kMaxChannels = 96;

/// Calls `sample(ray, sampler, values)` for each sample of each pixel of the tile; it fills one
/// value per channel of the film. Samples with a value that is not finite count as black.
template <class Sample>
void for_each_camera_sample(const Scene& scene, const Film& film, FilmTile& tile,
                            const SampleRange& range, RenderCounters& counters, Sample&& sample) {
  const Camera& camera = *scene.camera;
  const bool has_lens = camera.has_lens();
  const bool unit_box = film.filter().is_unit_box();
  const size_t n = film.channels().size();
  std::array<float, kMaxChannels> values, sums;
  const PixelBounds& b = tile.sampled();
  for (int y = b.y0; y < b.y1; ++y)
    for (int x = b.x0; x < b.x1; ++x) {
      const uint64_t pixel = uint64_t(y) * uint64_t(film.full_size().x) + uint64_t(x);
      Sampler sampler(range.sequence, range.seed, range.scramble, pixel);
      std::fill_n(sums.begin(), n, 0.0f);
      for (uint32_t i = 0; i < range.count; ++i) {
        sampler.start_sample(range.first + i);
        const Point2f u = sampler.next_2d();
        const Point2f position{float(x) + u.x, float(y) + u.y};
        Point2f lens{};
        if (has_lens) {
          sampler.start_dimension(kLensDimension);
          lens = sampler.next_2d();
        }
        std::fill_n(values.begin(), n, 0.0f);
        sample(camera.sample_ray(position, lens), sampler, std::span(values.data(), n));
        bool finite = true;
        for (size_t c = 0; c < n; ++c) finite &= std::isfinite(values[c]);
        if (!finite) {
          ++counters.nonfinite_samples;
          std::fill_n(values.begin(), n, 0.0f);
        }
        if (unit_box)
          for (size_t c = 0; c < n; ++c) sums[c] += values[c];
        else
          tile.add_sample(film.filter(), position, std::span(values.data(), n));
      }
      counters.camera_paths += range.count;
      if (unit_box) tile.add_to_pixel(x, y, std::span(sums.data(), n), float(range.count));
    }
}

}  // namespace duet
