#include "integrators/learn_emission.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "base/parallel.h"
#include "integrators/importance_map.h"
#include "integrators/pilot.h"
#include "transport/light_choice.h"
#include "transport/light_subpath.h"

namespace duet {

namespace {

/// Light sub-paths of each round. Those of the first are aimed at where camera sub-paths have been,
/// the others by what the rounds before have learned.
constexpr std::array<uint32_t, 3> kRounds = {2048, 4096, 8192};
constexpr uint32_t kRaysPerBlock = 64;
constexpr uint64_t kRoundSeed = 0x656d6974ull, kAimSeed = 0x61696dull;
/// Camera sub-paths for each side of the image, and the most segments of paths that are looked at.
constexpr int kImportonSide = 32, kMostSegments = 8;
/// Of the rays of an iteration, in parts of the number of pixels; see most_counted().
constexpr double kMostCounted = 0.25;
/// From fewer rays nothing can be learned.
constexpr size_t kFewestUseful = 8;
/// By how much a guide has to make useful rays denser, in their mean, to be worth its time.
constexpr double kLeastGain = 2;

/// A ray that was of use, and by how much the guide had changed its density.
struct UsefulRay {
  EmissionGuide::Record record;
  float factor;
};

/// By how much a guide may raise densities as weights count them: to so many rays for each pixel's
/// area. The balance heuristic takes densities for variances; where photons are counted as denser
/// they take the weight from light samples, which have far less noise than their densities say.
float most_counted(const Scene& scene, Point2i film) {
  const double disk = std::numbers::pi * sqr(double(scene.accel->bounds().radius()));
  const double visible = sqr(pixel_footprint(scene, film)) * double(film.x) * double(film.y);
  return float(std::max(1.0, kMostCounted * disk / visible));
}

class EmissionLearner {
 public:
  EmissionLearner(const Scene& scene, const LightPassPlan& plan, std::vector<Importon> importons)
      : scene_(scene),
        plan_(plan),
        guide_(guide_by(aimed_at(importons))),
        importance_(std::move(importons)) {
    plan_.max_depth = std::min(plan_.max_depth, kMostSegments);
  }

  /// `most` as for EmissionGuide.
  std::unique_ptr<const EmissionGuide> run(float most) {
    std::vector<EmissionGuide::Record> records;
    std::vector<UsefulRay> rays;
    for (uint32_t round = 0; round < kRounds.size(); ++round) {
      rays = trace(round);
      // Where most rays are of use, more rounds change little.
      if (rays.size() > kRounds[round] / 2 && !(gain(rays) > kLeastGain)) return nullptr;
      for (UsefulRay& r : rays) {
        records.push_back(r.record);
        records.back().weight /= float(kRounds[round]);
      }
      if (records.size() >= kFewestUseful) guide_ = guide_by(records);
    }
    if (!(gain(rays) > kLeastGain)) return nullptr;
    return guide_by(std::move(records), most);
  }

 private:
  /// By how much the guide has made useful rays denser, in the mean over their weights.
  static double gain(const std::vector<UsefulRay>& rays) {
    double sum = 0, denser = 0;
    for (const UsefulRay& r : rays) {
      sum += double(r.record.weight);
      denser += double(r.record.weight) * double(r.factor);
    }
    return sum > 0 ? denser / sum : 0.0;
  }

  std::unique_ptr<EmissionGuide> guide_by(std::vector<EmissionGuide::Record> records,
                                          float most = INFINITY) const {
    return std::make_unique<EmissionGuide>(scene_.lights, scene_.emission_picker,
                                           std::move(records), most);
  }

  /// Rays of lights to points where camera sub-paths have been, as often of each light as light
  /// samples choose it there.
  std::vector<EmissionGuide::Record> aimed_at(const std::vector<Importon>& importons) const {
    std::vector<EmissionGuide::Record> records;
    std::vector<float> chosen(scene_.lights.size());
    float all = 0;
    for (size_t i = 0; i < importons.size(); ++i) {
      const Importon& to = importons[i];
      all += to.weight;
      Sampler sampler(SampleSequence::independent, kAimSeed, scene_.lights.size(), i);
      sampler.start_sample(0);
      const ChosenLight light = choose_light(scene_, to.position, sampler);
      if (!light.sample) continue;
      chosen[light.light] += to.weight;
      if (!scene_.lights[light.light]->entered_sphere())
        records.push_back(record(light.light, light.sample->wi, to.position, to.weight));
    }
    for (uint32_t light = 0; light < scene_.lights.size(); ++light)
      if (scene_.lights[light]->entered_sphere() && chosen[light] > 0)
        aim(light, importons, chosen[light] / all, records);
    return records;
  }

  /// One ray of a light that is infinitely far away through each point, by its own choice of
  /// direction.
  void aim(uint32_t light, const std::vector<Importon>& importons, float scale,
           std::vector<EmissionGuide::Record>& records) const {
    for (size_t i = 0; i < importons.size(); ++i) {
      Sampler sampler(SampleSequence::independent, kAimSeed, light, i);
      sampler.start_sample(0);
      const auto e = scene_.lights[light]->sample_emission({0.5f, 0.5f}, sampler.next_2d());
      if (!e) continue;
      const Importon& to = importons[i];
      records.push_back(record(light, -e->ray.direction, to.position, to.weight * scale));
    }
  }

  EmissionGuide::Record record(uint32_t light, const Vector3f& from, const Point3f& through,
                               float weight) const {
    const auto numbers = EmissionGuide::guided_numbers(*scene_.lights[light], from, through);
    return {light, from, numbers.value_or(Point2f{0.5f, 0.5f}), weight};
  }

  std::vector<UsefulRay> trace(uint32_t round) const {
    return parallel_append<UsefulRay>(
        kRounds[round], kRaysPerBlock, plan_.threads, [&](size_t i, std::vector<UsefulRay>& rays) {
          RenderCounters counters;
          Sampler sampler(SampleSequence::independent, kRoundSeed, round, i);
          sampler.start_sample(0);
          if (const auto ray = trace(sampler, counters)) rays.push_back(*ray);
        });
  }

  std::optional<UsefulRay> trace(Sampler& sampler, RenderCounters& counters) const {
    const LightStarts starts(scene_, guide_.get());
    const auto start = start_light_subpath(scene_, starts, sampler);
    if (!start) return std::nullopt;
    float use = 0;
    const auto visit = [&](const PathVertex& v, const Hit&) {
      // Light samples find best what lights send directly.
      if (!v.is_smooth() || (plan_.set.light_samples && v.depth == 1)) return;
      use += v.throughput.max() * importance_(v.position(), v.wo);
    };
    trace_light_subpath(
        {scene_, starts, plan_.set, plan_.subpath, plan_.max_depth, sampler, counters}, start,
        visit);
    if (!(use > 0 && use < INFINITY)) return std::nullopt;
    const Ray& ray = start->emission.ray;
    const Vector3f from = -ray.direction;
    const auto density = [&](const LightStarts& of) {
      return of.density(start->index, 1, from, ray.origin);
    };
    const float factor = density(starts) / density(LightStarts(scene_));
    // The least variance has a density in proportion to the root of the mean square of the use,
    // which the root of the use is nearer to than the use itself where that differs much.
    const float weight = std::sqrt(use * factor) / factor;
    return UsefulRay{record(start->index, from, ray.origin, weight), factor};
  }

  const Scene& scene_;
  LightPassPlan plan_;
  std::unique_ptr<const EmissionGuide> guide_;
  ImportanceMap importance_;
};

}  // namespace

std::unique_ptr<const EmissionGuide> learn_emission(const Scene& scene, Point2i film,
                                                    const LightPassPlan& plan) {
  const auto is_guided = [](const auto& light) {
    return EmissionGuide::guided_numbers(*light, {0, 0, 1}, {0, 0, 0}).has_value();
  };
  if (!(has_light_choice(scene) ||
        std::any_of(scene.lights.begin(), scene.lights.end(), is_guided)) ||
      scene.needs_media_vertices() || plan.max_depth < 1)
    return nullptr;
  const int depth = std::min(plan.max_depth, kMostSegments);
  std::vector<Importon> importons =
      trace_importons(scene, film, kImportonSide, depth, plan.subpath, plan.threads);
  return EmissionLearner(scene, plan, std::move(importons)).run(most_counted(scene, film));
}

}  // namespace duet
