#include "integrators/wide_tiles.h"

#include <array>
#include <cmath>

#include "base/instruction_sets.h"
#include "image/batch_adder.h"

namespace duet {

namespace {

constexpr int kSize = Film::kTileSize;
static_assert(kSize * kSize <= kBatch);

/// The square of the full image in which a tile lies, as far as there is light.
PixelBounds whole_square(const Film& film, const FilmTile& tile) {
  const int x = tile.sampled().x0 / kSize * kSize, y = tile.sampled().y0 / kSize * kSize;
  const FilmLayout& layout = film.layout();
  const PixelBounds full{0, 0, layout.full.x, layout.full.y};
  return PixelBounds{x, y, x + kSize, y + kSize}.intersect(layout.ends_at_crop ? layout.crop
                                                                               : full);
}

/// What it takes to add samples with layers beside their colours.
struct LayerAdder {
  const Scene& scene;
  const CameraIntegrator& method;
  const SampleRange& range;
  SampleAdder& sums;
  RenderCounters& counters;
  std::vector<float> values;
};

}  // namespace

/// What one thread needs for a tile.
struct WideTiles::Workspace {
  Workspace(const Camera& c, std::unique_ptr<WideWalk> w) : camera(c), walk(std::move(w)) {}

  void enter(const PixelBounds& pixels, int width, const SampleRange& range,
             const BatchSampler& sampler);
  /// Begins the paths of a sample; returns how many there are.
  int start_paths(uint32_t index, BatchSampler& sampler);
  /// Pixels of the range.
  uint64_t meant_within(const PixelBounds& bounds) const;
  /// Weights samples by the camera's weights; whether no film can add some of them.
  bool weight_samples();
  /// Makes those black.
  void drop_large(const PixelBounds& bounds, RenderCounters& counters);
  void add_to(BatchAdder& sums) const {
    sums.add({x, y, samples.r, samples.g, samples.b, samples.alpha});
  }
  /// One by one.
  void add_to(SampleAdder& sums, const PixelBounds& bounds) const;
  /// The same of samples number `index` with their layers.
  void add_to(LayerAdder& adder, const PixelBounds& bounds, uint32_t index) const;
  /// Calls `f(x, y, id)` for the pixels of the range within bounds.
  template <class F>
  void for_each_meant(const PixelBounds& bounds, const F& f) const;

  const Camera& camera;
  std::unique_ptr<WideWalk> walk;
  PixelBounds square;
  int count = 0;
  BatchArray<uint64_t> pixels{};
  BatchArray<uint64_t> pixel_keys{};
  BatchArray<bool> is_meant{};  ///< whether the range has the pixel
  BatchKeys keys{};
  BatchArray<float> x{}, y{}, lens_x{}, lens_y{};
  BatchArray<float> weight{};  ///< of the camera's rays
  WideSamples samples{};
};

void WideTiles::Workspace::enter(const PixelBounds& bounds, int width, const SampleRange& range,
                                 const BatchSampler& sampler) {
  square = bounds;
  count = 0;
  for (int py = square.y0; py < square.y1; ++py)
    for (int px = square.x0; px < square.x1; ++px, ++count) {
      pixels[count] = uint64_t(py) * uint64_t(width) + uint64_t(px);
      pixel_keys[count] = sampler.pixel_key(pixels[count]);
      is_meant[count] = has_pixel(range, pixels[count]);
    }
  walk->enter({pixels.data(), size_t(count)});
}

int WideTiles::Workspace::start_paths(uint32_t index, BatchSampler& sampler) {
  sampler.start_sample(index, count, pixel_keys, keys);
  sampler.numbers_2d(count, keys, 0, x, y);
  if (camera.has_lens()) sampler.numbers_2d(count, keys, kLensDimension, lens_x, lens_y);
  samples = {};
  WidePaths& paths = walk->paths();
  int n = 0, id = 0;
  for (int py = square.y0; py < square.y1; ++py)
    for (int px = square.x0; px < square.x1; ++px, ++id) {
      weight[id] = 0;
      if (!is_meant[id]) continue;
      x[id] += float(px), y[id] += float(py);
      const CameraRay ray = camera.sample_ray({x[id], y[id]}, {lens_x[id], lens_y[id]});
      weight[id] = ray.weight;
      if (ray.weight == 0) continue;
      paths.start(n++, id, ray, keys);
    }
  return n;
}

bool WideTiles::Workspace::weight_samples() {
  const auto is_large = [](float v) {
    return std::abs(v) <= float(ExactSum::kLargest) ? 0 : 1;  // also what is not a number
  };
  int large = 0;
  DUET_LANES
  for (int id = 0; id < count; ++id) {
    const float r = samples.r[id] * weight[id], g = samples.g[id] * weight[id],
                b = samples.b[id] * weight[id];
    samples.r[id] = r, samples.g[id] = g, samples.b[id] = b;
    large |= is_large(r) | is_large(g) | is_large(b) | is_large(samples.alpha[id]);
  }
  return large != 0;
}

void WideTiles::Workspace::drop_large(const PixelBounds& bounds, RenderCounters& counters) {
  for (int id = 0; id < count; ++id) {
    const float values[]{samples.r[id], samples.g[id], samples.b[id], samples.alpha[id]};
    if (film_can_add(std::span<const float>(values))) continue;
    samples.r[id] = samples.g[id] = samples.b[id] = samples.alpha[id] = 0;
    counters.nonfinite_samples +=
        bounds.contains(square.x0 + id % square.width(), square.y0 + id / square.width());
  }
}

template <class F>
void WideTiles::Workspace::for_each_meant(const PixelBounds& bounds, const F& f) const {
  int id = 0;
  for (int py = square.y0; py < square.y1; ++py)
    for (int px = square.x0; px < square.x1; ++px, ++id)
      if (is_meant[id] && bounds.contains(px, py)) f(px, py, id);
}

void WideTiles::Workspace::add_to(SampleAdder& sums, const PixelBounds& bounds) const {
  for_each_meant(bounds, [&](int px, int py, int id) {
    sums.add(px, py, {x[id], y[id]},
             std::array{samples.r[id], samples.g[id], samples.b[id], samples.alpha[id]});
  });
}

void WideTiles::Workspace::add_to(LayerAdder& a, const PixelBounds& bounds, uint32_t index) const {
  const std::span<float> values(a.values);
  for_each_meant(bounds, [&](int px, int py, int id) {
    std::fill(values.begin(), values.end(), 0.0f);
    values[0] = samples.r[id], values[1] = samples.g[id], values[2] = samples.b[id];
    values[3] = samples.alpha[id];
    const Point2f position{x[id], y[id]}, lens{lens_x[id], lens_y[id]};
    if (weight[id] != 0) {
      std::optional<NextRays> next;
      if (a.method.looks_at_next_rays()) next = camera.next_rays(position, lens);
      Sampler sampler(a.range.sequence, a.range.seed, a.range.scramble, pixels[id]);
      sampler.start_sample(index);
      a.method.add_layers(a.scene,
                          {camera.sample_ray(position, lens), pixels[id], index, weight[id],
                           next ? &*next : nullptr},
                          sampler, a.counters, values);
    }
    if (!film_can_add(std::span<const float>(values))) {
      ++a.counters.nonfinite_samples;
      std::fill(values.begin(), values.end(), 0.0f);
    }
    a.sums.add(px, py, position, values);
  });
}

uint64_t WideTiles::Workspace::meant_within(const PixelBounds& bounds) const {
  uint64_t n = 0;
  for_each_meant(bounds, [&](int, int, int) { ++n; });
  return n;
}

WideTiles::WideTiles(const Scene& scene, const CameraIntegrator& method, MakeWalk make_walk)
    : scene_(scene), method_(method), make_walk_(std::move(make_walk)) {}

WideTiles::~WideTiles() = default;

void WideTiles::render(const Film& film, FilmTile& tile, const SampleRange& range,
                       const TileSamples& samples, RenderCounters& counters) {
  auto workspace =
      workspaces_.take([&] { return std::make_unique<Workspace>(*scene_.camera, make_walk_()); });
  BatchSampler sampler(range.sequence, range.seed, range.scramble);
  workspace->enter(whole_square(film, tile), film.full_size().x, range, sampler);
  const PixelBounds& bounds = tile.sampled();
  const auto trace = [&](auto&& add) {
    for (uint32_t i = samples.first; i < samples.first + samples.count; ++i) {
      const int n = workspace->start_paths(i, sampler);
      workspace->walk->trace(n, sampler, workspace->samples, counters);
      const bool has_large = workspace->weight_samples();
      if (has_large && !method_.has_layers()) workspace->drop_large(bounds, counters);
      add(i);
    }
  };
  if (method_.has_layers()) {
    SampleAdder sums(film, tile);
    LayerAdder adder{scene_, method_,  range,
                     sums,   counters, std::vector<float>(method_.channels().size())};
    trace([&](uint32_t i) { workspace->add_to(adder, bounds, i); });
  } else if (!range.phase && BatchAdder::suits(film)) {
    BatchAdder sums(film, tile, workspace->square);
    trace([&](uint32_t) { workspace->add_to(sums); });
  } else {
    SampleAdder sums(film, tile);
    trace([&](uint32_t) { workspace->add_to(sums, bounds); });
  }
  counters.camera_paths += workspace->meant_within(bounds) * samples.count;
  workspaces_.give_back(std::move(workspace));
}

}  // namespace duet
