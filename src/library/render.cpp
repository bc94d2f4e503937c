#include "duet/render.h"

#include <algorithm>
#include <chrono>
#include <limits>
#include <stdexcept>

#include "base/memory_limit.h"
#include "base/parallel.h"
#include "duet/version.h"
#include "evaluate/report/denoised_image.h"
#include "evaluate/report/memory_estimate.h"
#include "evaluate/report/scene_mattes.h"
#include "evaluate/report/scene_render.h"
#include "library/contents.h"
#include "scene/build.h"
#include "scene/film_layout.h"

namespace duet {

namespace {

/// Where so many pixels end, or the last place of all.
int end_of(int begin, int count) {
  return int(std::min(int64_t(begin) + count, int64_t(std::numeric_limits<int>::max())));
}

FilmLayout layout_of(FilmDescription& film, const RenderSettings& settings) {
  std::optional<Point2i> size;
  if (settings.size) size = Point2i{(*settings.size)[0], (*settings.size)[1]};
  std::optional<PixelBounds> crop;
  if (settings.crop) {
    const auto [x, y, w, h] = *settings.crop;
    crop = PixelBounds{x, y, end_of(x, w), end_of(y, h)};
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

/// One call of render_file().
class FileRender {
 public:
  FileRender(const SceneFile& scene, const RenderSettings& settings, const RenderWatch& watch)
      : scene_file_(scene.name()),
        settings_(settings),
        watch_(watch),
        description_(scene.contents().loaded.description) {}

  std::optional<RenderedImage> run() {
    check_settings(settings_);
    check_watch();
    prepare();
    build();
    decide();
    check_memory();
    watch_render();
    RenderResult result = render(*scene_, *integrator_, layout_, request_);
    tell_end(result);
    if (result.spp == 0) return std::nullopt;
    return finished(std::move(result));
  }

 private:
  using Contents = RenderedImage::Contents;

  void check_watch() const {
    if (!(watch_.image_seconds >= 0))
      throw std::invalid_argument(
          fmt::format("image_seconds: {} is not a number from zero", watch_.image_seconds));
  }

  /// Everything that can be wrong with the settings for this scene shows here.
  void prepare() {
    if (settings_.sensor >= description_.sensors.size())
      throw std::out_of_range(fmt::format("sensor {}: the scene has {}", settings_.sensor,
                                          description_.sensors.size()));
    SensorDescription& sensor = description_.sensors[settings_.sensor];
    layout_ = layout_of(sensor.film, settings_);
    const IntegratorOverride method{settings_.integrator, settings_.parameters, settings_.layers};
    if (settings_.denoise) hidden_ = add_denoiser_layers(description_.integrator, method);
    integrator_ = method_of(description_, sensor, method, technique_output(settings_.techniques),
                            diagnostics_);
    mattes_.emplace(matte_kinds(settings_.cryptomatte), description_.integrator);
    std::string warning;
    request_ = request_of(sensor.sampler, sample_options(settings_), *integrator_, warning);
    if (settings_.denoise) load_denoiser();
    record_ = record_of(description_.integrator, *integrator_, request_);
    record_.scene_file = scene_file_;
    warn(record_.bias);
    warn(warning);
    view_ = opening_view(sensor);
    planned_spp_ = request_.budget.spp.value_or(sensor.sampler.sample_count);
  }

  void load_denoiser() {
    try {
      denoiser_.emplace(request_.threads);
    } catch (const std::runtime_error& e) {
      throw DenoiserError(e.what());
    }
  }

  void warn(const std::string& text) const {
    if (watch_.warning && !text.empty()) watch_.warning(text);
  }

  void build() {
    BuildOptions build{settings_.sensor, request_.threads,
                       integrator_needs(description_.integrator)};
    mattes_->ask_for_names(description_, build);
    scene_ = build_scene(std::move(description_), build, diagnostics_);
    std::vector<SceneMessage> messages = scene_messages(diagnostics_);
    if (diagnostics_.has_errors()) throw SceneError(std::move(messages));
    for (const SceneMessage& m : messages) warn(m.text);
  }

  /// Lets a method that chooses another one do so.
  void decide() {
    integrator_->begin(*scene_, {layout_.full, planned_spp_, request_.threads});
    if (const MethodDecision* decision = integrator_->decision()) record_.decision = *decision;
    record_.bias = integrator_->bias();
    record_.noise_only = integrator_->blurs() || !record_.bias.empty();
  }

  void check_memory() const {
    MemoryEstimate estimate = estimate_memory(*integrator_, layout_, request_.budget,
                                              view_.film.component_format == ComponentFormat::half);
    estimate.copies += mattes_->memory_bytes(layout_, scene_->motion != nullptr);
    const std::string why = memory_refusal(estimate, memory_in_use(), memory_limit());
    if (!why.empty()) throw MemoryError(why);
  }

  /// Passes on what is there of the render while it is under way.
  void watch_render() {
    request_.cancel = watch_.cancel;
    if (watch_.progress)
      request_.progress = [this](const RenderProgress& p) {
        fraction_ = p.fraction;
        watch_.progress({p.fraction, p.spp, p.seconds});
      };
    if (!watch_.image_so_far) return;
    using Clock = std::chrono::steady_clock;
    request_.wants_snapshot = [this, last = Clock::now()]() mutable {
      if (std::chrono::duration<double>(Clock::now() - last).count() < watch_.image_seconds)
        return false;
      last = Clock::now();
      return true;
    };
    request_.snapshot = [this](RenderResult result) {
      Contents made = facts_of(result);
      made.image = shown(std::move(result.image));
      watch_.image_so_far(handle(std::move(made)));
    };
  }

  /// The last progress, which renders have that end before there is any other, too.
  void tell_end(const RenderResult& result) const {
    if (!watch_.progress) return;
    watch_.progress({result.interrupted ? fraction_ : 1, double(result.spp), result.seconds});
  }

  /// All of an image but its pixels.
  Contents facts_of(const RenderResult& result) const {
    Contents made{{},
                  form_of(view_, layout_, *integrator_),
                  scene_header(record_, view_, layout_.full),
                  result.interrupted};
    for (HeaderField& field : samples_header(record_, result))
      made.header.push_back(std::move(field));
    return made;
  }

  /// Without what was rendered for the denoiser alone.
  Image shown(Image image) const {
    return hidden_.empty() ? std::move(image) : without_channels(image, hidden_);
  }

  static RenderedImage handle(Contents made) {
    return RenderedImage(std::make_shared<const Contents>(std::move(made)));
  }

  RenderedImage finished(RenderResult result) const {
    Contents made = facts_of(result);
    mattes_->add(*scene_, layout_, request_, result, made.form, made.header);
    if (denoiser_) denoise(result.image, made);
    made.image = shown(std::move(result.image));
    return handle(std::move(made));
  }

  /// If it fails the noisy image is there nevertheless.
  void denoise(const Image& noisy, Contents& made) const {
    try {
      Contents clean{denoised_image(*denoiser_, noisy, integrator_->layers_tell_noise()), made.form,
                     denoised_header(made.header, denoiser_->name()), made.interrupted};
      made.denoised = std::make_shared<const Contents>(std::move(clean));
    } catch (const std::bad_alloc&) {
      made.denoiser_failure = "there is not enough memory for the denoised image";
    } catch (const std::runtime_error& e) {
      made.denoiser_failure = e.what();
    }
  }

  const std::string& scene_file_;
  const RenderSettings& settings_;
  const RenderWatch& watch_;
  SceneDescription description_;
  SensorDescription view_;
  FilmLayout layout_;
  RenderRequest request_;
  RenderRecord record_;
  int planned_spp_ = 0;
  double fraction_ = 0;  ///< as it was told last
  Diagnostics diagnostics_;
  std::optional<SceneMattes> mattes_;
  std::optional<Denoiser> denoiser_;
  std::vector<std::string> hidden_;  ///< channels that are rendered for the denoiser alone
  std::unique_ptr<Integrator> integrator_;
  std::unique_ptr<Scene> scene_;
};

}  // namespace

const char* library_version() {
  return DUET_VERSION;
}

std::optional<RenderedImage> render_file(const SceneFile& scene, const RenderSettings& settings,
                                         const RenderWatch& watch) {
  return FileRender(scene, settings, watch).run();
}

}  // namespace duet
