#include "integrators/bidirectional.h"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

#include "base/failures.h"
#include "integrators/bidirectional_batches.h"
#include "integrators/learn_emission.h"
#include "integrators/motion_blur.h"

namespace duet {

namespace {

/// Exponent with which the radius of a method's merging shrinks unless the user says otherwise.
/// Source: Kaplanyan & Dachsbacher, "Adaptive Progressive Photon Mapping", 2013, for 2/3; Georgiev
/// et al., "Light Transport Simulation with Vertex Connection and Merging", 2012, for 3/4.
double default_alpha(BidirectionalMethod method) {
  return method == BidirectionalMethod::vcm ? 0.75 : 2.0 / 3;
}
/// Light sub-paths per pixel unless the user says otherwise: as measured (docs/performance.md).
double default_light_paths(BidirectionalMethod method) {
  return method == BidirectionalMethod::bdpt || method == BidirectionalMethod::vcm ? 0.25 : 1.0;
}
/// No roulette lets a path become longer than this.
constexpr int kUnlimited = 60000;

bool merges(BidirectionalMethod m) {
  return m == BidirectionalMethod::ppm || m == BidirectionalMethod::bpm ||
         m == BidirectionalMethod::vcm;
}
bool connects(BidirectionalMethod m) {
  return m == BidirectionalMethod::bdpt || m == BidirectionalMethod::reuse ||
         m == BidirectionalMethod::vcm;
}

int depth_limit(const BidirectionalIntegratorDescription& d) {
  if (d.max_depth >= 0) return std::min(d.max_depth, kUnlimited);
  if (d.method == BidirectionalMethod::reuse && d.weights != ReuseWeights::exact)
    return std::min(d.max_eye_depth + d.max_light_depth + 1, kUnlimited);
  return kUnlimited;
}

}  // namespace

BidirectionalIntegrator::BidirectionalIntegrator(const Options& options, const CameraOutput& output,
                                                 PathBatches batches)
    : CameraIntegrator(output),
      options_(options),
      max_depth_(depth_limit(options)),
      is_thesis_(options.method == Method::reuse && options.weights != ReuseWeights::exact),
      path_batches_(batches) {
  if (!(options_.light_paths > 0)) options_.light_paths = default_light_paths(options.method);
  windows_.eye = options.max_eye_depth;
  windows_.light = options.max_light_depth;
  windows_.tail = options.continue_probability;
  if (output.techniques == TechniqueOutput::none) return;
  if (max_depth_ > TechniqueLayers::kMaxDepth)
    throw std::invalid_argument(
        fmt::format("an image for each technique needs a \"max_depth\" of at most {}",
                    TechniqueLayers::kMaxDepth));
  raw_techniques_ = output.techniques == TechniqueOutput::raw;
  layers_.enabled = true;
  for (int k = 1; k <= max_depth_; ++k)
    for (int s = 0; s <= k; ++s) {
      const int t = k + 1 - s;
      if (has_technique(s, t))
        layers_.connections[size_t(s)][size_t(t)] = add_colour_layer(fmt::format("s{}t{}", s, t));
      // A merge has one vertex more than a path of as many segments.
      if (merges(options_.method) && s >= 1 && t >= 2 && k >= 2)
        layers_.merges[size_t(s + 1)][size_t(t)] =
            add_colour_layer(fmt::format("merge_s{}t{}", s + 1, t));
    }
}

BidirectionalIntegrator::~BidirectionalIntegrator() = default;

bool BidirectionalIntegrator::has_technique(int s, int t) const {
  if (s == 0) return t == 2 || options_.method != Method::ptracer;
  if (s + t == 2) return false;
  if (options_.method == Method::ptracer) return t == 1;
  if (t == 1 && !options_.light_image) return false;
  if (options_.method == Method::reuse) return windows_.share(s, t) > 0;
  if (s >= 2 && t >= 2 && options_.connections == 0) return false;
  return connects(options_.method) || (s == 1 && merges(options_.method));
}

std::string BidirectionalIntegrator::bias() const {
  if (!is_thesis_) return "";
  return fmt::format(
      "the weights of the thesis do not sum to one (reading {}): the image is biased, by how much "
      "depends on the scene; weights=exact is unbiased",
      options_.weights == ReuseWeights::thesis_a ? "a" : "b");
}

uint32_t BidirectionalIntegrator::most_phases(Point2i film) const {
  // Photons have to be those of the same time: the fewer of them, the more noise.
  if (merges(options_.method)) return 1;
  // Each phase needs light sub-paths.
  return light_subpaths(film) < PixelPhases::kMost ? 1 : PixelPhases::kMost;
}

bool BidirectionalIntegrator::blurs() const {
  return merges(options_.method);
}

double BidirectionalIntegrator::memory_bytes(const FilmLayout& film) const {
  // Roulette leaves few sub-paths with more vertices than this.
  constexpr int kMostVertices = 6;
  int vertices = std::clamp(max_depth_ - 1, 0, kMostVertices);
  if (options_.method == Method::reuse) vertices = std::min(vertices, options_.max_light_depth);
  LightPassPlan plan;
  plan.subpaths = light_subpaths(film.full);
  plan.keep_vertices =
      merges(options_.method) || (connects(options_.method) && options_.connections != 0);
  plan.keep_connection_vertices = may_take_eye_batches() && options_.connections != 0;
  if (options_.method == Method::reuse && !is_thesis_) plan.windows = &windows_;
  return LightPass::memory_bytes(plan, vertices) +
         (merges(options_.method)
              ? VertexGrid::memory_bytes(double(plan.subpaths) * double(vertices))
              : 0.0);
}

void BidirectionalIntegrator::prepare(Film& film) const {
  CameraIntegrator::prepare(film);
  const bool has_colours = !film.channels().empty() && film.channels()[0] == "R";
  if (!has_colours) return;
  film.add_splat_layer(0);
  gather_moments(film);
  if (!layers_.enabled) return;
  for (int s = 2; s <= max_depth_; ++s)
    if (const size_t first = layers_.connection(s, 1)) film.add_splat_layer(first);
}

uint32_t BidirectionalIntegrator::light_subpaths(Point2i film) const {
  const double pixels = double(film.x) * film.y;
  return uint32_t(std::clamp(std::round(options_.light_paths * pixels), 1.0, 4e9));
}

double BidirectionalIntegrator::radius(uint32_t iteration) const {
  const double first = options_.radius > 0 ? options_.radius : pilot_->first_radius();
  const double alpha = options_.alpha > 0 ? options_.alpha : default_alpha(options_.method);
  return first * std::pow(double(iteration) + 1, 0.5 * (alpha - 1));
}

TechniqueSet BidirectionalIntegrator::techniques(Point2i film, uint32_t iteration) const {
  TechniqueSet set;
  set.hits = set.light_samples = connects(options_.method);
  set.connections = set.light_samples && options_.connections != 0;
  set.camera_connections =
      options_.light_image && (set.light_samples || options_.method == Method::ptracer);
  set.merges = merges(options_.method);
  set.light_paths = float(light_subpaths(film));
  set.partly_merged = set.merges && set.light_samples && !options_.merge_parts.empty();
  set.pixel_group = options_.pixel_group;
  if (!pilot_) return set;  // for which it is
  if (set.connections && options_.connections > 0) {
    // Of none there is no share, and so no connection.
    set.connections = pilot_->vertices_per_subpath > 0;
    if (set.connections)
      set.connection_share = float(options_.connections / pilot_->vertices_per_subpath);
  }
  if (set.merges) set.merge_area = kPi * sqr(float(radius(iteration)));
  return set;
}

void BidirectionalIntegrator::render_samples(const Scene& scene, Film& film,
                                             const SampleRange& samples, const PassControl& control,
                                             RenderCounters& counters) {
  // Other calls may be for other scenes.
  batches_ = make_batches(scene);
  for_each_sample(samples, control, [&](const SampleRange& one, const PassControl& part) {
    PassControl whole = part;
    // Eye and light sub-paths belong together: an iteration that has begun is finished.
    whole.cancelled = [] { return false; };
    whole.is_finished = true;
    iteration(scene, film, one, whole, counters);
  });
  batches_.reset();
}

LightPassPlan BidirectionalIntegrator::light_plan(Point2i film) const {
  LightPassPlan plan;
  plan.mask = &mask_;
  plan.subpath = {options_.rr_depth, options_.strict_normals};
  plan.max_depth = max_depth_ - 1;
  if (options_.method == Method::reuse)
    plan.max_depth = std::min(plan.max_depth, options_.max_light_depth);
  plan.subpaths = light_subpaths(film);
  plan.unit_weights = options_.method == Method::ptracer;
  plan.hide_emitters = options_.hide_emitters;
  plan.guide = guide_.get();
  if (options_.method == Method::reuse && !is_thesis_) plan.windows = &windows_;
  return plan;
}

void BidirectionalIntegrator::choose(const Scene& scene, const RenderOutlook& outlook) {
  if (pilot_) return;
  if (options_.pixel_group > 1 && !takes_groups(scene))
    throw SceneFailure(
        "\"pixel_group\" of the integrator \"bdpt\" is for scenes whose sub-paths are traced in "
        "batches: not where something moves, in media, with an image for each technique, "
        "\"connections\" above 0 or a \"max_depth\" of 0");
  windows_.light_paths = light_subpaths(outlook.film);
  // What the sensor cannot be connected with, it finds by itself.
  options_.light_image &= scene.camera->connectible();
  mask_ = {outlook.film, options_.merge_parts};
  LightPassPlan plan = light_plan(outlook.film);
  plan.set = techniques(outlook.film, 0);
  plan.threads = outlook.threads;
  if (options_.guide_emission) guide_ = learn_emission(scene, outlook.film, plan);
  plan.guide = guide_.get();
  pilot_ = run_pilot(scene, outlook.film, plan);
}

void BidirectionalIntegrator::iteration(const Scene& scene, Film& film, const SampleRange& samples,
                                        const PassControl& control, RenderCounters& counters) {
  // Who renders films one by one need not say so before.
  if (!pilot_) choose(scene, {film.full_size()});
  LightPassPlan plan = light_plan(film.full_size());
  plan.set = techniques(film.full_size(), samples.first);
  plan.sequence = samples.sequence;
  plan.seed = samples.seed;
  plan.scramble = samples.scramble;
  plan.iteration = samples.first;
  plan.threads = control.threads;
  plan.keep_vertices = plan.set.merges || plan.set.connections;
  plan.tracer = batches_ ? &batches_->lights : nullptr;
  const bool eye_batches = batches_ && batches_->eye;
  plan.keep_connection_vertices = eye_batches && plan.set.connections;
  // A sub-path counts 1 / N_L.
  plan.roulette_threshold = pilot_->roulette_threshold() * plan.set.light_paths;
  set_ = plan.set;
  const uint64_t sequence_key = hash_combine(samples.seed, samples.scramble);
  sharing_.start(film.full_size(), sequence_key, samples.phase);
  if (samples.phase) plan.take_part(samples.phase->index, samples.phase->count);
  key_ = hash_combine(sequence_key, samples.first);
  if (scene.lights.empty()) plan.subpaths = 0;
  if (plan.keep_vertices)
    lights_.reserve(size_t(1.05 * pilot_->vertices_per_subpath * double(plan.subpaths)) + 1024,
                    plan.subpaths);
  Film& sums = film.begin_pass();
  if (plan.subpaths > 0 && (plan.keep_vertices || plan.set.camera_connections))
    lights_.run(
        scene, plan,
        [&](std::span<const LightSplat> splats, RenderCounters& of_block) {
          splat(sums, splats, of_block);
        },
        counters);
  if (set_.connections && options_.connections > 0) {
    const LightVertices& light = lights_.vertices();
    drawn_ = {light.vertices.size(), light.ends.size(), options_.connections};
  }
  if (set_.merges) {
    const std::vector<LightVertex>& v = lights_.vertices().vertices;
    grid_.build(
        uint32_t(v.size()),
        [&](uint32_t i) { return v[i].merges ? v[i].position : VertexGrid::nowhere(); },
        float(radius(samples.first)), control.threads);
  }
  if (eye_batches)
    trace_batches(sums, samples, control, counters);
  else
    CameraIntegrator::render_samples(scene, sums, samples, control, counters);
  if (!samples.phase || samples.phase->is_last()) film.end_pass();
}

void BidirectionalIntegrator::splat(Film& film, std::span<const LightSplat> splats,
                                    RenderCounters& counters) const {
  if (film.splat_layer_count() == 0) return;
  const float scale = 1 / set_.light_paths;
  std::vector<Splat> chosen;
  const auto add = [&](size_t layer, int depth, bool weighted) {
    chosen.clear();
    for (const LightSplat& s : splats) {
      if (depth > 0 && s.depth != depth) continue;
      Splat out = s.splat;
      if (weighted) out.value *= s.weight;
      if (film_can_add(out.value))
        chosen.push_back(out);
      else
        counters.nonfinite_samples += layer == 0;
    }
    film.add_splats(layer, chosen, scale);
  };
  add(0, 0, true);
  if (!layers_.enabled) return;
  size_t layer = 1;
  for (int s = 2; s <= max_depth_; ++s)
    if (layers_.connection(s, 1)) add(layer++, s - 1, !raw_techniques_);
}

std::unique_ptr<Integrator> make_bidirectional(const BidirectionalIntegratorDescription& d,
                                               const CameraOutput& output) {
  return std::make_unique<BidirectionalIntegrator>(d, output);
}

}  // namespace duet
