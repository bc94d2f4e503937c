#include "integrators/matte_pass.h"

#include <algorithm>

#include "base/parallel.h"
#include "integrators/motion_blur.h"
#include "integrators/vertex_sample.h"
#include "scene/scene_motion.h"

namespace duet {

namespace {

/// A ray that passes as many surfaces sees the next one, whatever that lets through.
constexpr uint32_t kMostPassed = 256;

/// How many samples of a pixel have seen each thing.
class IdCounts {
 public:
  void add(uint32_t id) {
    const auto entry =
        std::find_if(counts_.begin(), counts_.end(), [&](const Count& c) { return c.id == id; });
    if (entry == counts_.end())
      counts_.push_back({id, 1});
    else
      ++entry->samples;
  }
  /// Ids and coverages of those that are seen most, to `values`.
  void write(uint32_t spp, float* values) {
    const size_t ranks = std::min(kMatteRanks, counts_.size());
    std::partial_sort(counts_.begin(), counts_.begin() + ptrdiff_t(ranks), counts_.end(),
                      [](const Count& a, const Count& b) {
                        return a.samples != b.samples ? a.samples > b.samples : a.id < b.id;
                      });
    for (size_t i = 0; i < ranks; ++i) {
      values[2 * i] = matte_value(counts_[i].id);
      values[2 * i + 1] = float(double(counts_[i].samples) / double(spp));
    }
  }

 private:
  struct Count {
    uint32_t id, samples;
  };
  std::vector<Count> counts_;
};

std::vector<uint32_t> ids_of(const std::vector<std::string>& names) {
  std::vector<uint32_t> ids;
  for (const std::string& name : names) ids.push_back(matte_id(name));
  return ids;
}

class MattePass {
 public:
  MattePass(const Scene& scene, const SceneNames& names, const FilmLayout& layout,
            const MatteRequest& request)
      : scene_(scene),
        layout_(layout),
        request_(request),
        shapes_(ids_of(names.shapes)),
        materials_(ids_of(names.materials)),
        instances_(ids_of(names.instances)) {
    for (size_t i = 0; i < names.instances.size(); ++i)
      instance_is_named_.push_back(!names.instances[i].empty());
  }

  Image run() {
    std::vector<std::string> channels;
    for (const MatteKind kind : request_.kinds)
      for (std::string& name : matte_channels(kind)) channels.push_back(std::move(name));
    const PixelBounds& window = layout_.crop;
    Image image(window.width(), window.height(), std::move(channels));
    const SampleRange all{request_.sequence, request_.seed, 0, 0, request_.spp};
    if (scene_.motion)
      count_moving(all, image);
    else
      for_each_row([&](int row) {
        Row counts = empty_row();
        count(row, all, counts);
        write(row, counts, image);
      });
    return image;
  }

 private:
  /// Of each pixel one for each kind.
  using Row = std::vector<IdCounts>;

  Row empty_row() const { return Row(size_t(layout_.crop.width()) * request_.kinds.size()); }

  template <class Work>
  void for_each_row(const Work& work) const {
    parallel_for(size_t(layout_.crop.height()), request_.threads,
                 [&](size_t row) { work(int(row)); });
  }

  /// The scene is posed for a part of a sample of all pixels at a time, so that all of them are
  /// counted together.
  void count_moving(const SampleRange& all, Image& image) const {
    const MotionLease lease(scene_.motion.get());
    std::vector<Row> rows(size_t(layout_.crop.height()), empty_row());
    MotionPhases phases;
    phases.start(scene_, layout_.full, PixelPhases::kMost, all);
    for_each_pose(scene_, phases, all, PassControl(),
                  [&](const SampleRange& some, const PassControl&) {
                    for_each_row([&](int row) { count(row, some, rows[size_t(row)]); });
                  });
    for_each_row([&](int row) { write(row, rows[size_t(row)], image); });
  }

  void count(int row, const SampleRange& range, Row& counts) const {
    const Camera& camera = *scene_.camera;
    const bool has_lens = camera.has_lens();
    const PixelBounds& window = layout_.crop;
    const int y = window.y0 + row;
    for (int x = window.x0; x < window.x1; ++x) {
      const uint64_t pixel = uint64_t(y) * uint64_t(layout_.full.x) + uint64_t(x);
      if (!has_pixel(range, pixel)) continue;
      Sampler sampler(range.sequence, range.seed, range.scramble, pixel);
      for (uint32_t i = range.first; i < range.first + range.count; ++i) {
        sampler.start_sample(i);
        const Point2f u = sampler.next_2d();
        if (has_lens) sampler.start_dimension(kLensDimension);
        const Point2f lens = has_lens ? sampler.next_2d() : Point2f{};
        const CameraRay ray = camera.sample_ray({float(x) + u.x, float(y) + u.y}, lens);
        const auto hit = ray.weight != 0 ? first_seen(ray, sampler) : std::nullopt;
        for (size_t k = 0; hit && k < request_.kinds.size(); ++k)
          counts[size_t(x - window.x0) * request_.kinds.size() + k].add(
              id_of(request_.kinds[k], *hit));
      }
    }
  }

  /// The first surface on the way of a ray that lets the sample's light not pass straight.
  std::optional<Hit> first_seen(Ray ray, Sampler& sampler) const {
    Hit hit;
    for (uint32_t vertex = 0; scene_.accel->closest_hit(ray, hit); ++vertex) {
      const Shape& shape = scene_.shapes[hit.shape];
      const Material& material = *scene_.materials[shape.material];
      const bool hidden = request_.hides_lights && shape.light != kNone;
      if (vertex == kMostPassed || !(hidden || material.passes_straight())) return hit;
      const Surface s = scene_.surface(ray, hit);
      if (!hidden) {
        const auto sample = sample_vertex(material.bind(s, -ray.direction), vertex, sampler);
        if (!sample || !sample->null) return hit;
      }
      ray = spawn_ray(s, ray.direction);
    }
    return std::nullopt;
  }

  uint32_t id_of(MatteKind kind, const Hit& hit) const {
    if (kind == MatteKind::material) return materials_[scene_.shapes[hit.shape].material];
    const bool by_instance = hit.instance != kNone && instance_is_named_[hit.instance];
    return by_instance ? instances_[hit.instance] : shapes_[hit.shape];
  }

  void write(int row, Row& counts, Image& image) const {
    const size_t kinds = request_.kinds.size();
    for (int x = 0; x < image.width; ++x)
      for (size_t k = 0; k < kinds; ++k)
        counts[size_t(x) * kinds + k].write(request_.spp,
                                            image.pixel(x, row) + k * 2 * kMatteRanks);
  }

  const Scene& scene_;
  const FilmLayout& layout_;
  const MatteRequest& request_;
  const std::vector<uint32_t> shapes_, materials_, instances_;
  std::vector<bool> instance_is_named_;
};

}  // namespace

Image render_mattes(const Scene& scene, const SceneNames& names, const FilmLayout& layout,
                    const MatteRequest& request) {
  return MattePass(scene, names, layout, request).run();
}

double matte_bytes(const FilmLayout& layout, size_t kinds, bool moves) {
  const double pixels = double(layout.crop.width()) * layout.crop.height();
  // What is counted of a pixel in which a few things are seen.
  constexpr double counts = sizeof(IdCounts) + 4 * 2 * sizeof(uint32_t);
  return pixels * double(kinds) * (2 * kMatteRanks * sizeof(float) + (moves ? counts : 0.0));
}

}  // namespace duet
