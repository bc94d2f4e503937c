#include "integrators/camera_integrator.h"

#include <cmath>

#include "image/sample_adder.h"
#include "integrators/tile_work.h"

namespace duet {

namespace {

bool is_moment(LayerKind kind) {
  return kind == LayerKind::moments || kind == LayerKind::variance ||
         kind == LayerKind::sample_variance || kind == LayerKind::relative_variance;
}

bool is_statistic(LayerKind kind) {
  return is_moment(kind) || kind == LayerKind::samples;
}

/// Whether a layer is made of what the ray meets.
bool looks_at_hits(LayerKind kind) {
  return !is_statistic(kind) && kind != LayerKind::denoise_split;
}

/// Most images have this many channels: a number that is known takes no loop.
constexpr size_t kColours = 4;

inline void clear(std::span<float> values) {
  if (values.size() == kColours)
    std::fill_n(values.data(), kColours, 0.0f);
  else
    std::fill(values.begin(), values.end(), 0.0f);
}

inline bool can_add(std::span<const float> values) {
  return values.size() == kColours ? film_can_add(values.first<kColours>()) : film_can_add(values);
}

}  // namespace

CameraIntegrator::CameraIntegrator(const CameraOutput& output)
    : image_(output.image), frame_(output.frame) {
  if (image_) channels_ = {"R", "G", "B", "A"};
  for (const Layer& layer : output.layers) {
    const std::vector<std::string> names = layer_channels(layer);
    layers_.push_back({layer.kind, channels_.size(), names.size(), layer.in_frame});
    channels_.insert(channels_.end(), names.begin(), names.end());
    looks_at_first_hit_ |= looks_at_hits(layer.kind);
    looks_at_next_rays_ |= layer_needs_next_rays(layer.kind);
    follows_specular_ |= layer_follows_specular(layer.kind);
  }
}

std::vector<std::string> CameraIntegrator::data_channels() const {
  std::vector<std::string> names;
  for (const PlacedLayer& layer : layers_)
    if (layer.kind != LayerKind::albedo && layer.kind != LayerKind::denoise_albedo)
      names.insert(names.end(), channels_.begin() + ptrdiff_t(layer.first),
                   channels_.begin() + ptrdiff_t(layer.first + layer.channels));
  return names;
}

size_t CameraIntegrator::add_colour_layer(const std::string& name) {
  const size_t first = channels_.size();
  for (const char* c : {".R", ".G", ".B"}) channels_.push_back(name + c);
  colour_layers_.push_back(first);
  return first;
}

bool CameraIntegrator::tiles_may_differ() const {
  for (const PlacedLayer& layer : layers_)
    if (is_statistic(layer.kind)) return false;
  return true;
}

void CameraIntegrator::gather_moments(Film& film) const {
  for (const PlacedLayer& layer : layers_)
    if (is_moment(layer.kind)) film.add_moments(layer.first);
}

void CameraIntegrator::sample(const Scene& scene, const CameraPath& path, Sampler& sampler,
                              RenderCounters& counters, std::span<float> values) const {
  if (image_) {
    Spectrum l = radiance(scene, path, sampler, counters, values);
    if (path.weight != 1) {
      l *= path.weight;
      for (const size_t first : colour_layers_)
        for (size_t c = first; c < first + 3; ++c) values[c] *= path.weight;
    }
    values[0] = l.r, values[1] = l.g, values[2] = l.b;
  }
  if (has_layers()) add_layers(scene, path, sampler, counters, values);
}

void CameraIntegrator::add_layers(const Scene& scene, const CameraPath& path, Sampler& sampler,
                                  RenderCounters& counters, std::span<float> values) const {
  const Ray& ray = path.ray;
  const Spectrum l = image_ ? Spectrum(values[0], values[1], values[2]) : Spectrum();
  Hit hit;
  const bool found = looks_at_first_hit_ && scene.accel->closest_hit(ray, hit);
  counters.closest_rays += looks_at_first_hit_;
  Surface surface;
  if (found) surface = scene.surface(ray, hit);
  SpecularView specular;
  if (found && follows_specular_)
    specular = follow_specular(scene, ray, surface, sampler, counters);
  for (const PlacedLayer& layer : layers_) {
    const std::span<float> out = values.subspan(layer.first);
    if (is_moment(layer.kind))
      out[0] = l.r * l.r, out[1] = l.g * l.g, out[2] = l.b * l.b;
    else if (layer.kind == LayerKind::denoise_split)
      evaluate_split(path.sample, l, out);
    else if (found)
      evaluate_layer(
          layer.kind, scene,
          {surface, -ray.direction, hit, path.next, &specular, layer.in_frame ? &frame_ : nullptr},
          out);
  }
}

void CameraIntegrator::render_samples(const Scene& scene, Film& film, const SampleRange& samples,
                                      const PassControl& control, RenderCounters& counters) {
  const TileSplit split =
      control.is_finished ? TileSplit::by_samples_and_rows : TileSplit::by_samples;
  for_each_tile(film, samples, control, split, counters,
                [&](FilmTile& tile, const TileSamples& part, RenderCounters& c) {
                  SampleRange own = samples;
                  own.first = part.first, own.count = part.count;
                  if (looks_at_next_rays_)
                    render_tile<true>(scene, film, tile, own, c);
                  else
                    render_tile<false>(scene, film, tile, own, c);
                });
}

template <bool kWithNextRays>
void CameraIntegrator::render_tile(const Scene& scene, const Film& film, FilmTile& tile,
                                   const SampleRange& range, RenderCounters& counters) const {
  const Camera& camera = *scene.camera;
  const bool has_lens = camera.has_lens();
  std::vector<float> storage(channels_.size());
  const std::span<float> values(storage);
  const std::unique_ptr<PathWorkspace> workspace = make_workspace(scene);
  [[maybe_unused]] std::optional<NextRays> next;
  const PixelBounds& b = tile.sampled();
  SampleAdder sums(film, tile);
  for (int y = b.y0; y < b.y1; ++y)
    for (int x = b.x0; x < b.x1; ++x) {
      const uint64_t pixel = uint64_t(y) * uint64_t(film.full_size().x) + uint64_t(x);
      if (!has_pixel(range, pixel)) continue;
      counters.camera_paths += range.count;
      Sampler sampler(range.sequence, range.seed, range.scramble, pixel);
      for (uint32_t i = range.first; i < range.first + range.count; ++i) {
        sampler.start_sample(i);
        const Point2f u = sampler.next_2d();
        const Point2f position{float(x) + u.x, float(y) + u.y};
        Point2f lens{};
        if (has_lens) {
          sampler.start_dimension(kLensDimension);
          lens = sampler.next_2d();
        }
        clear(values);
        const CameraRay ray = camera.sample_ray(position, lens);
        CameraPath path{ray, pixel, i, ray.weight, nullptr, workspace.get()};
        if constexpr (kWithNextRays)
          if ((next = camera.next_rays(position, lens))) path.next = &*next;
        if (ray.weight != 0) sample(scene, path, sampler, counters, values);
        if (!can_add(values)) {
          ++counters.nonfinite_samples;
          clear(values);
        }
        sums.add(x, y, position, values);
      }
    }
}

void CameraIntegrator::prepare(Film& film) const {
  using Kind = FilmStatistic::Kind;
  for (const PlacedLayer& layer : layers_) {
    if (layer.kind == LayerKind::samples) film.add_statistic({Kind::samples, layer.first});
    if (layer.kind == LayerKind::variance) film.add_statistic({Kind::variance, layer.first});
    if (layer.kind == LayerKind::sample_variance)
      film.add_statistic({Kind::sample_variance, layer.first});
    if (layer.kind == LayerKind::relative_variance)
      film.add_statistic({Kind::relative_variance, layer.first});
  }
}

}  // namespace duet
