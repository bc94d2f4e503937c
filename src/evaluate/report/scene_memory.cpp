#include "evaluate/report/scene_memory.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <set>
#include <stdexcept>
#include <utility>
#include <variant>
#include <vector>

#include "base/diagnostics.h"
#include "base/parallel.h"
#include "evaluate/report/memory_estimate.h"
#include "evaluate/report/scene_parts.h"
#include "image/image_facts.h"
#include "integrators/make_integrator.h"
#include "scene/build.h"
#include "scene/film_layout.h"
#include "textures/bitmap_pixels.h"

namespace duet {

namespace {

/// Measured at the peak of building, beyond the arrays of the description, and rounded up: Embree's
/// trees and what it builds them from, and what the scene has of its own.
constexpr double kTriangleBytes = 115, kSegmentBytes = 180, kInstanceBytes = 250,
                 kShapeBytes = 1000, kLightTriangleBytes = 80;
/// What each thread renders in (docs/performance.md), and tiles of its own.
constexpr double kThreadBytes = 16e6;

double geometry_bytes(const SceneDescription& scene) {
  double bytes = 0;
  for_each_shape(scene, [&](const ShapeDescription& s) {
    bytes += kShapeBytes;
    double triangles = 0;
    if (std::holds_alternative<InstanceShape>(s.geometry)) bytes += kInstanceBytes;
    if (const auto mesh = own_triangles(s)) triangles = double(mesh->triangles.size());
    if (const auto* c = std::get_if<CurvesShape>(&s.geometry); c && c->curves)
      bytes += kSegmentBytes * double(c->curves->segments.size());
    bytes += triangles * (kTriangleBytes + (s.emission ? kLightTriangleBytes : 0));
  });
  return bytes;
}

/// What images take: texels that stay, and the most that there is beside them while they are read.
class ImageBytes {
 public:
  void texture(const std::string& file, const BitmapDecoding& decoding) {
    if (!seen_.emplace(file, decoding).second) return;
    const Source s = source(file);
    const bool grey = s.facts.channels < 3 || (decoding.channel != TextureChannel::all &&
                                               decoding.channel != TextureChannel::number);
    const int channels = grey ? 1 : 3;
    const bool changes = decoding.colors || decoding.channel == TextureChannel::number ||
                         (decoding.gamma && s.facts.numbers != StoredNumbers::bytes);
    const TexelType type = changes                                    ? TexelType::single
                           : s.facts.numbers == StoredNumbers::bytes  ? TexelType::byte
                           : s.facts.numbers == StoredNumbers::halves ? TexelType::half
                                                                      : TexelType::single;
    const double kept = s.texels * double(BitmapPixels::texel_bytes(type, channels));
    const double floats = s.texels * sizeof(float) * channels;
    add(s, kept, type == TexelType::byte ? s.decoded : std::max(s.decoded + floats - kept, floats));
  }
  /// Texels become colours and tables of where the light is.
  void environment(const std::string& file) {
    const Source s = source(file);
    constexpr double kTexelBytes = 24, kToBuild = 16;
    add(s, s.texels * kTexelBytes, s.texels * kToBuild);
  }
  double total() {
    // The largest may be read at the same time.
    std::sort(beside_.begin(), beside_.end(), std::greater<>());
    const size_t at_once = size_t(std::min(HardwareThreads().count(), kImagesAtOnce));
    double sum = kept_;
    for (size_t i = 0; i < std::min(at_once, beside_.size()); ++i) sum += beside_[i];
    return sum;
  }

 private:
  struct Source {
    ImageFacts facts;
    double file = 0, texels = 0, decoded = 0;  ///< the second a number, the others bytes
  };

  static Source source(const std::string& file) {
    Source s;
    std::error_code error;
    const auto size = std::filesystem::file_size(file, error);
    if (error) return s;  // said when it is read
    s.file = double(size);
    try {
      s.facts = read_image_facts(file);
      s.texels = double(s.facts.width) * s.facts.height;
    } catch (const ReadError&) {
      constexpr double kUnpacked = 4;
      s.facts.channels = 3;
      s.texels = kUnpacked * s.file / double(BitmapPixels::texel_bytes(TexelType::single, 3));
    }
    const double number = s.facts.numbers == StoredNumbers::bytes ? 1 : sizeof(float);
    s.decoded = s.texels * s.facts.channels * number;
    return s;
  }
  /// `beside`: what there is beside what is kept once the file itself is gone.
  void add(const Source& s, double kept, double beside) {
    kept_ += kept;
    beside_.push_back(std::max({0.0, s.file + s.decoded - kept, beside}));
  }

  std::set<std::pair<std::string, BitmapDecoding>> seen_;
  double kept_ = 0;
  std::vector<double> beside_;
};

double image_bytes(const SceneDescription& scene) {
  ImageBytes images;
  for (const TextureDescription& t : scene.textures)
    if (const auto* bitmap = std::get_if<BitmapTexture>(&t.model))
      images.texture(bitmap->file, bitmap->decoding());
  for (const LightDescription& l : scene.lights)
    if (const auto* map = std::get_if<EnvironmentMapLight>(&l.model)) images.environment(map->file);
  return images.total();
}

double film_bytes(const SceneDescription& scene, const IntegratorDescription& integrator) {
  FilmDescription film = scene.sensors[0].film;
  RenderBudget budget;
  budget.spp = scene.sensors[0].sampler.sample_count;
  try {
    return estimate_memory(*make_integrator(integrator), film_layout(film), budget,
                           film.component_format == ComponentFormat::half)
        .total();
  } catch (const std::invalid_argument&) {
    return 0;  // layers that do not exist: said when the scene is rendered
  }
}

double film_bytes(const SceneDescription& scene) {
  if (scene.sensors.empty()) return 0;
  if (!std::holds_alternative<AutoIntegratorDescription>(scene.integrator.method))
    return film_bytes(scene, scene.integrator);
  double most = 0;
  for (const IntegratorName& method : integrator_names()) {
    if (method.name == "auto" || !method_obstacle(scene, method.name).empty()) continue;
    IntegratorDescription integrator = scene.integrator;
    apply_override(integrator, {method.name, {}, {}});
    most = std::max(most, film_bytes(scene, integrator));
  }
  return most;
}

}  // namespace

SceneMemory estimate_scene_memory(const SceneDescription& scene) {
  SceneMemory m;
  m.description = memory_in_use();
  m.geometry = geometry_bytes(scene);
  m.images = image_bytes(scene);
  m.film = film_bytes(scene) + kThreadBytes * HardwareThreads().count();
  return m;
}

std::string describe(const SceneMemory& m) {
  return fmt::format("about {} to render: {} the description, {} geometry, {} images, {} the film",
                     memory_text(m.total()), memory_text(m.description), memory_text(m.geometry),
                     memory_text(m.images), memory_text(m.film));
}

}  // namespace duet
