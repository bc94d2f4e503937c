#include "scene/learn_environment.h"

#include <algorithm>
#include <array>

#include "base/parallel.h"
#include "math/sampler.h"

namespace duet {

namespace {

using Record = EnvironmentGuide::Record;

/// Camera sub-paths of each round. Light samples of the first are the environment's own, those of
/// the others are guided by the round before.
constexpr std::array<uint32_t, 3> kRounds = {2048, 4096, 8192};
constexpr uint64_t kLearningSeed = 0x736b79ull;
constexpr size_t kSubpathsPerBlock = 64;
constexpr int kMostVertices = 6, kSamplesPerVertex = 2, kMostPassed = 8;
/// Of the light that would arrive if nothing stood in its way. Where more does, there is little to
/// learn.
constexpr double kMostSeen = 0.5;
/// Of what is lit, on each side of the box.
constexpr double kOutside = 0.03;
/// By which the box is larger, in parts of its diagonal.
constexpr float kMargin = 1e-3f;
/// Of the second moment of light samples; what is spared beyond that has to pay for the time.
constexpr double kMostOfMoment = 0.5;
/// What other lights may bring for what the environment does: more, and its noise is not what is
/// seen.
constexpr double kMostOfOthers = 1;
/// From fewer light samples of a round nothing can be learned.
constexpr size_t kFewestFound = 16;

/// Light samples of a round, as they would be if nothing stood in their way, and records of those
/// that found light, and of samples of the BSDF that did.
struct Found {
  std::vector<Record> records;
  double seen = 0, unblocked = 0;
  double others = 0;  ///< what other lights bring
};

/// Whether a ray leaves the scene. Surfaces that may let it pass are passed.
bool leaves_scene(const Scene& scene, Ray ray) {
  if (!scene.has_passable_surfaces) return !scene.accel->occluded(ray);
  Hit hit;
  for (int passed = 0; scene.accel->closest_hit(ray, hit); ++passed) {
    const Surface s = scene.surface(ray, hit);
    if (passed == kMostPassed || !scene.materials[s.shape->material]->passes_straight())
      return false;
    ray = spawn_ray(s, ray.direction);
  }
  return true;
}

/// A direction that was tried, by a light sample or, with no contribution, by the BSDF.
struct Attempt {
  Record record;           ///< of other lights the place alone
  float contribution = 0;  ///< of the light sample, if nothing is in its way
  bool is_seen = true;
  bool of_other_light = false;
};

class Vertex {
 public:
  Vertex(const Scene& scene, const EnvironmentGuide& guide, const Surface& s, const Bsdf& bsdf)
      : scene_(scene), guide_(guide), s_(s), bsdf_(bsdf) {}

  /// What light from the unit direction `wi` counts: less where samples of the BSDF find it as
  /// well. Densities are those of all samples of the vertex together.
  std::optional<Record> record(const Vector3f& wi) const {
    const EnvironmentLight& light = *scene_.environment;
    const BsdfEval e = bsdf_.eval(wi, Transport::radiance);
    const PdfW plain = light.pdf_direct(s_.position, wi);
    const float use =
        e.value.luminance() * light.emitted(s_.position, wi).luminance() / (1 + e.pdf.value);
    if (!(use > 0 && use < INFINITY && plain.value > 0)) return std::nullopt;
    const float all =
        float(kSamplesPerVertex) * guide_.pdf(light, s_.position, wi).value + e.pdf.value;
    if (!(use / all < INFINITY)) return std::nullopt;
    return Record{s_.position, wi, use, {all}, plain};
  }

  void sample_light(const Point2f& u, std::vector<Attempt>& attempts) const {
    const auto light = guide_.sample_direct(*scene_.environment, s_.position, u);
    if (!light || !(light->pdf.value > 0)) return;
    const auto r = record(light->wi);
    if (r)
      attempts.push_back(
          {*r, r->use / light->pdf.value, leaves_scene(scene_, spawn_ray(s_, light->wi))});
  }

  /// One light sample of any light, if it is not the environment.
  void sample_others(float choice, const Point2f& u, std::vector<Attempt>& attempts) const {
    const LightPicker::Pick pick = scene_.direct_picker.pick(choice, u, s_.position);
    if (pick.light == scene_.environment_index) return;
    const auto light = scene_.lights[pick.light]->sample_direct(s_.position, u);
    if (!light) return;
    const float use =
        bsdf_.eval(light->wi, Transport::radiance).value.luminance() * light->weight.luminance();
    if (!(use > 0 && use < INFINITY)) return;
    const Ray ray = light->finite ? spawn_ray_to(s_, light->target) : spawn_ray(s_, light->wi);
    attempts.push_back({{s_.position, light->wi, 0, {}, {}},
                        use / pick.probability,
                        leaves_scene(scene_, ray),
                        true});
  }

 private:
  const Scene& scene_;
  const EnvironmentGuide& guide_;
  const Surface& s_;
  const Bsdf& bsdf_;
};

void camera_subpath(const Scene& scene, const EnvironmentGuide& guide, Ray ray, Sampler& sampler,
                    std::vector<Attempt>& attempts) {
  float throughput = 1;
  Hit hit;
  bool hits = scene.accel->closest_hit(ray, hit);
  for (int i = 0; i < kMostVertices && hits; ++i) {
    const Surface s = scene.surface(ray, hit);
    const Bsdf bsdf = scene.materials[s.shape->material]->bind(s, -ray.direction);
    const Vertex v(scene, guide, s, bsdf);
    if (bsdf.has_smooth())
      for (int k = 0; k < kSamplesPerVertex; ++k) {
        v.sample_light(sampler.next_2d(), attempts);
        if (scene.lights.size() > 1)
          v.sample_others(sampler.next_1d(), sampler.next_2d(), attempts);
      }
    const auto next = bsdf.sample(sampler.next_1d(), sampler.next_2d(), Transport::radiance);
    if (!next) return;
    ray = spawn_ray(s, next->wi);
    hits = scene.accel->closest_hit(ray, hit);
    if (!hits && !next->delta)
      if (const auto r = v.record(next->wi)) attempts.push_back({*r});
    // What carries less has fewer vertices, so that vertices count the same.
    throughput *= next->weight.max();
    if (!(sampler.next_1d() < throughput)) return;
    throughput = std::max(throughput, 1.0f);
  }
}

std::vector<Attempt> trace(const Scene& scene, Point2i film, const EnvironmentGuide& guide,
                           uint32_t round, int threads) {
  return parallel_append<Attempt>(
      kRounds[round], kSubpathsPerBlock, threads, [&](size_t i, std::vector<Attempt>& attempts) {
        Sampler sampler(SampleSequence::independent, kLearningSeed, round, i);
        sampler.start_sample(0);
        const Point2f at = sampler.next_2d();
        const Ray ray = scene.camera->sample_ray({at.x * float(film.x), at.y * float(film.y)},
                                                 sampler.next_2d());
        camera_subpath(scene, guide, ray, sampler, attempts);
      });
}

Found find(const std::vector<Attempt>& attempts) {
  Found found;
  for (const Attempt& a : attempts) {
    const double seen = a.is_seen ? double(a.contribution) : 0;
    if (a.of_other_light) {
      found.others += seen;
      continue;
    }
    found.unblocked += double(a.contribution);
    found.seen += seen;
    if (a.is_seen) found.records.push_back(a.record);
  }
  return found;
}

/// A box around what was lit, but for what is far from most of it.
Bounds room(const std::vector<Attempt>& attempts) {
  Bounds box;
  if (attempts.empty()) return box;
  std::vector<float> places(attempts.size());
  for (int k = 0; k < 3; ++k) {
    std::transform(attempts.begin(), attempts.end(), places.begin(),
                   [=](const Attempt& a) { return a.record.at[k]; });
    const auto quantile = [&](double q) {
      const auto place = places.begin() + ptrdiff_t(q * double(places.size() - 1));
      std::nth_element(places.begin(), place, places.end());
      return *place;
    };
    box.lower[k] = quantile(kOutside), box.upper[k] = quantile(1 - kOutside);
  }
  const Vector3f margin = Vector3f(kMargin * length(box.upper - box.lower));
  return {box.lower - margin, box.upper + margin};
}

}  // namespace

std::optional<EnvironmentGuide> learn_environment(const Scene& scene, Point2i film, int threads) {
  EnvironmentGuide guide;
  BoxWalls walls;
  for (uint32_t round = 0; round < kRounds.size(); ++round) {
    std::vector<Attempt> attempts = trace(scene, film, guide, round, threads);
    if (round == 0) walls = BoxWalls(room(attempts));
    std::erase_if(attempts, [&](const Attempt& a) { return !walls.holds(a.record.at); });
    const Found found = find(attempts);
    if (found.records.size() < kFewestFound || !(found.seen < kMostSeen * found.unblocked) ||
        found.others > kMostOfOthers * found.seen)
      return std::nullopt;
    guide = EnvironmentGuide(walls, found.records);
    // The first round has too few records to tell.
    if (round > 0 && !(guide.moment(found.records) < kMostOfMoment)) return std::nullopt;
  }
  return guide;
}

}  // namespace duet
