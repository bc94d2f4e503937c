#include "evaluate/render/render_scene.h"

#include <algorithm>

#include "base/failures.h"
#include "base/memory_limit.h"
#include "base/stopwatch.h"
#include "base/system/standard_streams.h"
#include "evaluate/live/live_display.h"
#include "evaluate/raw/identity.h"
#include "evaluate/render/asked.h"
#include "evaluate/render/raw_output.h"
#include "evaluate/render/scene_denoiser.h"
#include "evaluate/render/scene_images.h"
#include "evaluate/render/scene_method.h"
#include "evaluate/render/scene_operand.h"
#include "evaluate/report/memory_estimate.h"
#include "evaluate/report/render_report.h"
#include "evaluate/report/scene_mattes.h"
#include "evaluate/report/scene_render.h"
#include "scene/build.h"
#include "scene/features.h"

namespace duet {

namespace {

class SceneRenderer {
 public:
  SceneRenderer(const std::string& file, const RenderOptions& options, const RenderCall& call)
      : file_(file),
        options_(options),
        call_(call),
        batch_(call.batch),
        statistics_(call.statistics),
        messages_(call.messages) {}

  RenderOutcome run() {
    read();
    prepare();
    if (options_.skip_existing && images_->are_finished() && raw_->is_there()) {
      messages_.info("{}{}: skipped, {} exists", batch_.label(), file_, images_->planned()[0]);
      return target_outcome(images_->stored_result()) == RenderOutcome::target_missed
                 ? RenderOutcome::kept_target_missed
                 : RenderOutcome::not_rendered;
    }
    if (options_.writes_images) check_outputs(images_->planned());
    if (const std::string why = raw_->obstacle(); !why.empty()) throw SceneFailure(why);
    if (raw_->keeps_state()) scene_hash_ = scene_identity(description_, options_.sensor);
    build();
    if (call_.interrupt) return give_up();
    const std::optional<RawFilm> source = raw_->source();
    if (source) adopt_decision(*source, scene_hash_, record_, *integrator_);
    decide();
    record_.noise_only = integrator_->blurs() || !record_.bias.empty();
    check_memory();
    RenderState state;
    if (raw_->keeps_state()) raw_->set_image(image_of_raw_film());
    if (source) raw_->load(*source, request_.samples, state);
    const RenderResult result = render_with_progress(state);
    if (result.spp == 0) return give_up();
    seconds_.render = watch_.lap();
    std::vector<std::string> written;
    // Sums first: of those the image can be made again. If they cannot be written it still is.
    TryAll files;
    files.run([&] {
      if (const std::string raw = raw_->finish(state, result.interrupted); !raw.empty())
        written.push_back(raw);
    });
    files.run([&] {
      if (options_.writes_images)
        for (const std::string& path : write(result)) written.push_back(path);
    });
    files.finish();
    seconds_.write = watch_.lap();
    summarize(result, written);
    statistics_.add(record_, result, seconds_, count_parts(*scene_));
    return target_outcome(result);
  }

 private:
  void read() {
    LoadedScene loaded = load_scene(file_, options_.read, messages_);
    description_ = std::move(loaded.description);
    settings_ = loaded.files.fingerprint();
    for (const auto& [name, value] : loaded.parameters) settings_.add(name), settings_.add(value);
    seconds_.parse = watch_.lap();
    if (messages_.level() == Messages::Level::verbose)
      messages_.detail("{}: {}", file_, describe(scene_features(description_)));
  }

  /// Everything that can be wrong with the command line for this scene shows here.
  void prepare() {
    SensorDescription& sensor = chosen_sensor(description_, options_.sensor, file_);
    layout_ = asked_layout(sensor.film, options_);
    denoiser_.emplace(options_, description_.integrator);
    integrator_ = chosen_method(description_, sensor, options_, messages_);
    denoiser_->load();
    mattes_.emplace(options_.mattes, description_.integrator);
    make_request(sensor.sampler);
    record_ = record_of(description_.integrator, *integrator_, request_);
    if (!record_.bias.empty()) warn(record_.bias);
    view_ = opening_view(sensor);
    planned_spp_ = request_.budget.spp.value_or(sensor.sampler.sample_count);
    request_.samples = asked_samples(options_, planned_spp_);

    record_.command_line = call_.command_line;
    record_.scene_file = file_;
    Fingerprint scene;
    file_ == kStandardInput ? scene.add(options_.read.standard_input) : scene.add_file(file_);
    record_.scene_hash = scene.text();
    add_settings(settings_, record_, request_, options_, layout_, written_channels());
    OutputNames names = output_names(file_);
    names.integrator = record_.integrator;
    names.seed = fmt::to_string(record_.seed);
    images_.emplace(options_, file_, names, settings_, planned_spp_, messages_);
    names.spp = fmt::to_string(planned_spp_);
    raw_.emplace(options_, names, images_->planned()[0], messages_);
    FileUses uses = call_.uses;
    if (options_.writes_images) images_->add_to(uses);
    raw_->add_to(uses);
    request_.keeps_state = raw_->keeps_state();
  }

  RawImage image_of_raw_film() const {
    RawImage image = raw_image(record_, *integrator_, layout_);
    image.scene_hash = scene_hash_;
    image.techniques = options_.techniques == TechniqueOutput::none  ? "none"
                       : options_.techniques == TechniqueOutput::raw ? "raw"
                                                                     : "weighted";
    image.form = form_of(view_, layout_, *integrator_);
    image.header = scene_header(record_, view_, layout_.full);
    return image;
  }

  void make_request(const SamplerDescription& sampler) {
    std::string warning;
    try {
      request_ = request_of(
          sampler, {options_.budget, options_.seed, options_.strict_sampler, options_.threads},
          *integrator_, warning);
    } catch (const std::invalid_argument& e) {
      throw UsageError(e.what());
    }
    if (!warning.empty()) warn(warning);
    request_.cancel = &call_.interrupt;
  }

  /// A warning that --strict makes an error.
  void warn(const std::string& text) const {
    if (options_.read.strict) throw SceneFailure(text + " (an error because of --strict)");
    messages_.warning("{}: {}", file_, text);
  }

  /// Finds out before rendering what would be a pity to find out afterwards.
  void check_outputs(const std::vector<std::string>& planned) const {
    for (const std::string& path : planned)
      if (const std::string why = prepare_file(path); !why.empty()) throw SceneFailure(why);
    for (const std::string& path : planned)
      if (is_display_format(path))
        check_display_image(path, layout_.crop.width(), layout_.crop.height());
    check_formats(planned, written_channels(), options_.files);
    for (const std::string& text : settings_without_effect(planned, options_.files)) warn(text);
  }

  std::vector<std::string> written_channels() const {
    return mattes_->with_channels(denoiser_->shown(integrator_->channels()));
  }

  void build() {
    BuildOptions build{options_.sensor, options_.threads,
                       integrator_needs(description_.integrator)};
    mattes_->ask_for_names(description_, build);
    Diagnostics diagnostics;
    scene_ = build_scene(std::move(description_), build, diagnostics);
    report(diagnostics, options_.read.strict, messages_);
    seconds_.build = watch_.lap();
    messages_.detail("{}: read in {:.2f} s, built in {:.2f} s", file_, seconds_.parse,
                     seconds_.build);
  }

  /// Lets a method that chooses another one do so.
  void decide() {
    integrator_->begin(*scene_, {layout_.full, planned_spp_, options_.threads});
    const MethodDecision* decision = integrator_->decision();
    if (!decision) return;
    record_.decision = *decision;
    for (const std::string& line : decision->candidates)
      messages_.write(Messages::Level::verbose, line);
    record_.bias = integrator_->bias();
    messages_.info("{}: auto chose {}", file_, decision->reason);
  }

  /// Refuses an image for which there is no room before it takes what there is.
  void check_memory() const {
    MemoryEstimate estimate = estimate_memory(*integrator_, layout_, request_.budget,
                                              view_.film.component_format == ComponentFormat::half);
    estimate.copies += mattes_->memory_bytes(layout_, scene_->motion != nullptr);
    const MemoryLimit limit = memory_limit();
    messages_.detail("{}: {}; the limit is {} ({})", file_, describe(estimate),
                     memory_text(limit.bytes), limit.source);
    const std::string why = memory_refusal(estimate, memory_in_use(), limit);
    if (!why.empty()) throw SceneFailure(why);
  }

  RenderResult render_with_progress(RenderState& state) {
    const ShowProgress show =
        call_.progress(batch_.is_several() ? output_names(file_).scene : file_);
    request_.progress = [&](const RenderProgress& p) { show(p); };
    LiveDisplay live(options_.viewer, call_.page, images_->planned()[0], messages_);
    bool is_shown = false, is_written = false;
    request_.wants_snapshot = [&, writes = !has_standard_output()] {
      // Standard output takes one image: the last.
      is_written = writes && call_.wants_snapshot();
      is_shown = live.wants_image();
      return is_written || is_shown;
    };
    request_.snapshot = [&](RenderResult so_far) {
      if (is_shown) live.show(so_far);
      if (is_written) write_snapshot(std::move(so_far));
    };
    request_.after_pass = [&](const RenderState& so_far) { raw_->after_pass(so_far); };
    RenderResult result = render(*scene_, *integrator_, layout_, request_, state);
    if (result.spp > 0) live.show_last(result);
    return result;
  }

  bool has_standard_output() const {
    return std::ranges::any_of(images_->planned(), is_standard_output);
  }

  /// The image so far, for someone who is waiting: it is not finished, and if it cannot be written
  /// the render goes on nevertheless.
  void write_snapshot(RenderResult so_far) {
    so_far.interrupted = true;
    try {
      for (const std::string& path : write(so_far))
        messages_.info("{}: {} spp so far -> {}", file_, so_far.spp, path);
    } catch (const std::exception& e) {
      messages_.warning("{}: {}", file_, e.what());
    }
  }

  std::vector<std::string> write(RenderResult result) {
    HeaderFields header = scene_header(record_, view_, layout_.full);
    for (HeaderField& field : samples_header(record_, result)) header.push_back(std::move(field));
    ImageForm form = form_of(view_, layout_, *integrator_);
    mattes_->add(*scene_, layout_, request_, result, form, header);
    return denoiser_->write(*images_, *integrator_, result, form, header);
  }

  /// After an interrupt that came before every pixel had a sample: no file is replaced.
  RenderOutcome give_up() {
    messages_.warning("{}: interrupted before every pixel had a sample; no image is written",
                      file_);
    statistics_.add_failure(file_, {"interrupted before every pixel had a sample"}, true);
    return RenderOutcome::not_rendered;
  }

  void summarize(const RenderResult& r, const std::vector<std::string>& written) const {
    std::string text = batch_.label() + file_ + ": " + describe(record_, r);
    for (const std::string& p : written) text += " -> " + p;
    messages_.info("{}", text);
    if (r.counters.nonfinite_samples > 0)
      warn(fmt::format("{} of {} samples were not finite, or above {:.0e}, and count as black",
                       r.counters.nonfinite_samples, r.counters.camera_paths, ExactSum::kLargest));
  }

  /// Says so if the error that was asked for has not been reached.
  RenderOutcome target_outcome(const RenderResult& r) const {
    const std::string missed = target_miss(record_, r);
    if (missed.empty()) return RenderOutcome::rendered;
    messages_.warning("{}: {}", file_, missed);
    return RenderOutcome::target_missed;
  }

  const std::string& file_;
  const RenderOptions& options_;
  const RenderCall& call_;
  const Batch& batch_;
  StatisticsFile& statistics_;
  Messages& messages_;
  Stopwatch watch_;
  PhaseSeconds seconds_;
  SceneDescription description_;
  SensorDescription view_;
  FilmLayout layout_;
  RenderRequest request_;
  RenderRecord record_;
  int planned_spp_ = 0;
  Fingerprint settings_;
  std::optional<SceneImages> images_;
  std::optional<SceneDenoiser> denoiser_;
  std::optional<SceneMattes> mattes_;
  std::optional<RawOutput> raw_;
  std::string scene_hash_;  ///< if there is a raw film
  std::unique_ptr<Integrator> integrator_;
  std::unique_ptr<Scene> scene_;
};

}  // namespace

RenderOutcome render_scene(const std::string& file, const RenderOptions& options,
                           const RenderCall& call) {
  return SceneRenderer(file, options, call).run();
}

}  // namespace duet
