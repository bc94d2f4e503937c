#include "duet/render.h"

#include <chrono>
#include <stdexcept>

#include "base/memory_limit.h"
#include "base/parallel.h"
#include "duet/version.h"
#include "evaluate/report/memory_estimate.h"
#include "evaluate/report/scene_render.h"
#include "library/contents.h"
#include "scene/build.h"
#include "scene/film_layout.h"

namespace duet {

namespace {

/// Throws errors and passes warnings on.
void report(const Diagnostics& diagnostics, const RenderWatch& watch) {
  std::vector<SceneMessage> messages = scene_messages(diagnostics);
  if (diagnostics.has_errors()) throw SceneError(std::move(messages));
  if (!watch.warning) return;
  for (const SceneMessage& m : messages) watch.warning(m.text);
}

void check_memory(const Integrator& integrator, const FilmLayout& layout,
                  const RenderBudget& budget, bool half) {
  const MemoryEstimate estimate = estimate_memory(integrator, layout, budget, half);
  const std::string why = memory_refusal(estimate, memory_in_use(), memory_limit());
  if (!why.empty()) throw MemoryError(why);
}

FilmLayout layout_of(FilmDescription& film, const RenderSettings& settings) {
  std::optional<Point2i> size;
  if (settings.size) size = Point2i{(*settings.size)[0], (*settings.size)[1]};
  std::optional<PixelBounds> crop;
  if (settings.crop) {
    const auto [x, y, w, h] = *settings.crop;
    crop = PixelBounds{x, y, x + w, y + h};
  }
  return film_layout(film, size, crop);
}

SampleOptions sample_options(const RenderSettings& s) {
  return {{s.spp, s.seconds, s.target_error},
          s.seed,
          s.strict_sampler,
          startable_threads(threads_or_all(s.threads))};
}

TechniqueOutput technique_output(RenderedTechniques layers) {
  return layers == RenderedTechniques::raw        ? TechniqueOutput::raw
         : layers == RenderedTechniques::weighted ? TechniqueOutput::weighted
                                                  : TechniqueOutput::none;
}

/// The facts of one render that its images tell.
struct RenderFacts {
  SensorDescription view;
  ImageForm form;
  FilmLayout layout;
  RenderRecord record;

  RenderedImage image_of(RenderResult result) const {
    RenderedImage::Contents made{
        {}, form, scene_header(record, view, layout.full), result.interrupted};
    for (HeaderField& field : samples_header(record, result))
      made.header.push_back(std::move(field));
    made.image = std::move(result.image);
    return RenderedImage(std::make_shared<const RenderedImage::Contents>(std::move(made)));
  }
};

/// Passes on what is there of a render while it is under way.
void watch_render(const RenderWatch& watch, const RenderFacts& facts, RenderRequest& request) {
  request.cancel = watch.cancel;
  if (watch.progress)
    request.progress = [&watch](const RenderProgress& p) {
      watch.progress({p.fraction, p.spp, p.seconds});
    };
  if (!watch.image_so_far) return;
  using Clock = std::chrono::steady_clock;
  request.wants_snapshot = [&watch, last = Clock::now()]() mutable {
    if (std::chrono::duration<double>(Clock::now() - last).count() < watch.image_seconds)
      return false;
    last = Clock::now();
    return true;
  };
  request.snapshot = [&](RenderResult result) {
    watch.image_so_far(facts.image_of(std::move(result)));
  };
}

}  // namespace

int threads_or_all(int threads) {
  if (threads > 0) return threads;
  static const HardwareThreads all;
  return all.count();
}

const char* library_version() {
  return DUET_VERSION;
}

std::optional<RenderedImage> render_file(const SceneFile& scene, const RenderSettings& settings,
                                         const RenderWatch& watch) {
  SceneDescription description = scene.contents().loaded.description;
  if (settings.sensor >= description.sensors.size())
    throw std::out_of_range(
        fmt::format("sensor {}: the scene has {}", settings.sensor, description.sensors.size()));
  SensorDescription& sensor = description.sensors[settings.sensor];
  RenderFacts facts;
  facts.layout = layout_of(sensor.film, settings);
  Diagnostics diagnostics;
  const std::unique_ptr<Integrator> integrator =
      method_of(description, sensor, {settings.integrator, settings.parameters, settings.layers},
                technique_output(settings.techniques), diagnostics);
  std::string warning;
  RenderRequest request =
      request_of(sensor.sampler, sample_options(settings), *integrator, warning);
  facts.record = record_of(description.integrator, *integrator, request);
  facts.record.scene_file = scene.name();
  if (watch.warning)
    for (const std::string& text : {facts.record.bias, warning})
      if (!text.empty()) watch.warning(text);
  facts.view = opening_view(sensor);
  const int spp = request.budget.spp.value_or(sensor.sampler.sample_count);

  BuildOptions build{settings.sensor, request.threads, integrator_needs(description.integrator)};
  const std::unique_ptr<Scene> built = build_scene(std::move(description), build, diagnostics);
  report(diagnostics, watch);
  integrator->begin(*built, {facts.layout.full, spp, request.threads});
  if (const MethodDecision* decision = integrator->decision()) facts.record.decision = *decision;
  facts.record.bias = integrator->bias();
  facts.record.noise_only = integrator->blurs() || !facts.record.bias.empty();
  facts.form = form_of(facts.view, facts.layout, *integrator);
  check_memory(*integrator, facts.layout, request.budget, facts.form.half);

  watch_render(watch, facts, request);
  RenderResult result = render(*built, *integrator, facts.layout, request);
  if (result.spp == 0) return std::nullopt;
  return facts.image_of(std::move(result));
}

}  // namespace duet
