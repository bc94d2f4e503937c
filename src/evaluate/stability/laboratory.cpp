#include "evaluate/stability/laboratory.h"

#include <cmath>

#include "base/parallel.h"
#include "integrators/make_integrator.h"
#include "integrators/pass.h"
#include "math/hash.h"
#include "mitsuba/mitsuba.h"
#include "scene/build.h"

namespace duet::stability {

namespace {

std::string joined(const Settings& settings) {
  std::string text;
  for (const auto& [name, value] : settings) text += name + "=" + value + "\n";
  return text;
}

std::string messages(const Diagnostics& diagnostics) {
  std::string text;
  for (const Diagnostic& d : diagnostics.all())
    if (d.severity == Severity::error) text += (text.empty() ? "" : "\n") + d.to_string();
  return text;
}

uint64_t text_hash(const std::string& text) {
  uint64_t h = 0;
  for (const char c : text) h = hash_combine(h, uint64_t(uint8_t(c)));
  return h;
}

std::vector<std::pair<std::string, std::string>> listed(const Settings& settings) {
  return {settings.begin(), settings.end()};
}

}  // namespace

std::string SeriesPlan::key() const {
  return fmt::format("{}\n{}\n{}\n{}\n{} {} {} {}", scene, joined(defines), method,
                     joined(parameters), spp, independent, seed, target_error.value_or(0));
}

uint64_t SeriesPlan::batch_seed(int batch) const {
  return hash_combine(seed, uint64_t(batch));
}

RenderCounters Series::counters() const {
  RenderCounters sum;
  for (const Picture& p : pictures) sum.add(p.counters);
  return sum;
}

long Series::bad_pixels() const {
  long sum = 0;
  for (const Picture& p : pictures) sum += p.bad_pixels;
  return sum;
}

double Series::rays() const {
  const RenderCounters c = counters();
  return double(c.closest_rays + c.shadow_rays);
}

void Series::add(const Image& image, const RenderCounters& counters) {
  width = image.width, height = image.height;
  const size_t stride = image.channels.size();
  Picture& picture = pictures.emplace_back();
  picture.counters = counters;
  picture.grey.resize(pixels());
  for (size_t i = 0; i < pixels(); ++i) {
    const float* p = &image.data[i * stride];
    bool bad = false;
    for (int c = 0; c < 3; ++c) bad |= !(p[c] >= 0) || !std::isfinite(p[c]);
    picture.bad_pixels += bad;
    picture.grey[i] = (p[0] + p[1] + p[2]) / 3;
  }
}

Series Series::first(size_t count) const {
  Series part{width, height, method, {}};
  part.pictures.assign(pictures.begin(), pictures.begin() + ptrdiff_t(count));
  return part;
}

Series Series::without(int group, int groups) const {
  Series part{width, height, method, {}};
  for (size_t b = 0; b < pictures.size(); ++b)
    if (int(b) % groups != group) part.pictures.push_back(pictures[b]);
  return part;
}

namespace {

/// Makes the description that of the plan's method, and the method.
std::unique_ptr<Integrator> override_method(const SeriesPlan& plan,
                                            IntegratorDescription& description) {
  try {
    apply_override(description, {plan.method, listed(plan.parameters), {}});
    return make_integrator(description);
  } catch (const std::invalid_argument& e) {
    throw CatalogueError(fmt::format("{} with {}: {}", plan.scene, plan.method, e.what()));
  }
}

}  // namespace

struct Laboratory::BuiltScene {
  std::unique_ptr<Scene> scene;
  FilmLayout layout;
  IntegratorDescription integrator;
};

Laboratory::Laboratory(int threads, std::function<bool()> cancelled)
    : threads_(threads), cancelled_(std::move(cancelled)) {}
Laboratory::~Laboratory() = default;

Experiment Laboratory::prepare(const SeriesPlan& plan) {
  // By what lights are chosen is built into scenes.
  std::string selection;
  for (const auto& [name, value] : plan.parameters)
    if (name == "light_selection") selection = value;
  std::unique_ptr<BuiltScene>& built =
      scenes_[plan.scene + "\n" + joined(plan.defines) + "\n" + selection];
  if (!built) {
    auto fresh = std::make_unique<BuiltScene>();
    MitsubaOptions options;
    options.defines = listed(plan.defines);
    Diagnostics diagnostics;
    auto read = read_mitsuba(plan.scene, options, diagnostics);
    if (!read) throw CatalogueError(messages(diagnostics));
    for (const auto& [name, value] : plan.defines) {
      bool used = false;
      for (const auto& [known, ignored] : read->parameters) used |= known == name;
      if (!used) throw CatalogueError(fmt::format("{} has no parameter ${}", plan.scene, name));
    }
    const FilmDescription& film = read->description.sensors.at(0).film;
    fresh->layout = {{film.width, film.height}, {0, 0, film.width, film.height}, film.filter};
    fresh->integrator = read->description.integrator;
    if (!selection.empty()) override_method(plan, read->description.integrator);
    BuildOptions build;
    build.threads = threads_;
    fresh->scene = build_scene(std::move(read->description), build, diagnostics);
    if (!fresh->scene) throw CatalogueError(messages(diagnostics));
    built = std::move(fresh);
  }
  IntegratorDescription description = built->integrator;
  return {*built->scene, built->layout, override_method(plan, description)};
}

Image Laboratory::image(Experiment& experiment, const SeriesPlan& plan, int batch, int threads,
                        RenderCounters& counters) const {
  check_cancelled();
  RenderRequest request;
  if (plan.target_error)
    request.budget.target_error = plan.target_error;
  else
    request.budget.spp = plan.spp;
  request.seed = plan.batch_seed(batch);
  request.threads = threads;
  request.sequence = plan.independent ? SampleSequence::independent : SampleSequence::sobol;
  RenderResult result =
      duet::render(experiment.scene, *experiment.integrator, experiment.layout, request);
  counters.add(result.counters);
  return std::move(result.image);
}

void Laboratory::extend(Series& series, const SeriesPlan& plan,
                        const std::function<Image(Experiment&, int, RenderCounters&)>& one) {
  const size_t there = series.pictures.size();
  if (there >= size_t(plan.batches)) return;
  // Images are small, so each is made by one thread. The last bits of an image depend on which one
  // the integrator has made before, so that is the same for any number of threads.
  constexpr size_t kStrips = 8;
  std::vector<std::pair<Image, RenderCounters>> made(size_t(plan.batches) - there);
  const size_t strips = std::min(kStrips, made.size());
  std::vector<Experiment> experiments;
  for (size_t t = 0; t < strips; ++t) experiments.push_back(prepare(plan));
  parallel_for(strips, threads_, [&](size_t t) {
    for (size_t n = t; n < made.size(); n += strips)
      made[n].first = one(experiments[t], int(there + n), made[n].second);
  });
  const MethodDecision* taken = experiments.front().integrator->decision();
  series.method = taken ? taken->method : plan.method;
  for (const auto& [image, counters] : made) series.add(image, counters);
}

Series Laboratory::render(const SeriesPlan& plan) {
  Series& series = series_[plan.key()];
  extend(series, plan, [&](Experiment& e, int batch, RenderCounters& counters) {
    return image(e, plan, batch, 1, counters);
  });
  return series.first(size_t(plan.batches));
}

SeriesPlan subject_plan(const Row& row, const std::string& method, const Variant& variant) {
  SeriesPlan plan;
  plan.scene = row.scene;
  plan.defines = merged(row.defines, variant.defines);
  plan.method = method;
  plan.parameters =
      merged(settings_for(row.parameters, method), settings_for(variant.parameters, method));
  const auto effort = row.effort.find(method);
  plan.spp = int(std::ceil(row.spp * (effort == row.effort.end() ? 1 : effort->second)));
  plan.batches = row.batches;
  plan.independent = row.independent;
  plan.target_error = row.target_error;
  plan.seed = text_hash(row.name + "/" + method);
  return plan;
}

SeriesPlan reference_plan(const Row& row, const std::string& method, const Variant& variant) {
  const Reference& r = row.reference;
  const Variant none;
  const std::string by = r.method == "self" ? method : r.method;
  SeriesPlan plan = subject_plan(row, by, r.fixed ? none : variant);
  if (!r.scene.empty()) plan.scene = r.scene;
  plan.defines = merged(plan.defines, r.defines);
  plan.parameters = merged(plan.parameters, r.parameters);
  if (r.spp > 0) plan.spp = r.spp;
  if (r.batches > 0) plan.batches = r.batches;
  plan.target_error.reset();
  plan.independent = r.independent || row.independent;
  if (r.method != "self") plan.seed = text_hash(row.name + "/reference");
  return plan;
}

Series render_reference(Laboratory& laboratory, const Row& row, const std::string& method,
                        const Variant& variant, int batches) {
  SeriesPlan plan = reference_plan(row, method, variant);
  if (batches > 0) plan.batches = batches;
  if (row.reference.sum.empty()) return laboratory.render(plan);
  Series total;
  for (const Settings& defines : row.reference.sum) {
    SeriesPlan part = plan;
    part.defines = merged(plan.defines, defines);
    part.seed = text_hash(joined(defines)) ^ plan.seed;
    const Series s = laboratory.render(part);
    if (total.pictures.empty()) {
      total = s;
      continue;
    }
    for (size_t b = 0; b < s.pictures.size(); ++b) {
      for (size_t i = 0; i < s.pixels(); ++i) total.pictures[b].grey[i] += s.pictures[b].grey[i];
      total.pictures[b].bad_pixels += s.pictures[b].bad_pixels;
    }
  }
  return total;
}

}  // namespace duet::stability
