#include "app/render_scene.h"

#include <unistd.h>

#include <chrono>
#include <filesystem>

#include "app/commands.h"
#include "app/film_layout.h"
#include "app/output.h"
#include "app/signals.h"
#include "base/log.h"
#include "base/percent.h"
#include "scene/build.h"
#include "scene/features.h"

namespace duet {

namespace {

/// Lasts until the next lap.
class Stopwatch {
 public:
  double lap() {
    const auto now = std::chrono::steady_clock::now();
    const double seconds = std::chrono::duration<double>(now - start_).count();
    start_ = now;
    return seconds;
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// Refuses images that this machine has no room for, before they take all of it.
void check_memory(const FilmLayout& layout, const Integrator& integrator,
                  const RenderBudget& budget) {
  const size_t channels = integrator.channels().size();
  const double pixels = double(layout.crop.width()) * layout.crop.height();
  const double films = budget.target_error ? kErrorBatches : 1;
  const double bytes = pixels * films * double((channels + 1) * sizeof(double)) +
                       pixels * (films + 1) * double(channels * sizeof(float)) +
                       integrator.memory_bytes(layout);
  const double memory = double(sysconf(_SC_PHYS_PAGES)) * double(sysconf(_SC_PAGESIZE));
  if (bytes > memory)
    throw SceneFailure(fmt::format(
        "an image of {}x{} with {} channels takes {:.0f} GB of memory; there are {:.0f}",
        layout.crop.width(), layout.crop.height(), channels, bytes * 1e-9, memory * 1e-9));
}

SceneCounts count(const Scene& scene) {
  SceneCounts n;
  n.emitters = scene.lights.size();
  n.instances = scene.instances.size();
  for (const Shape& s : scene.shapes) n.triangles += s.mesh ? s.mesh->triangles.size() : 0;
  return n;
}

class SceneRenderer {
 public:
  SceneRenderer(const std::string& file, const RenderOptions& options, const Batch& batch,
                StatisticsFile& statistics)
      : file_(file), options_(options), batch_(batch), statistics_(statistics) {}

  bool run() {
    read();
    prepare();
    const std::vector<std::string> planned = paths(planned_spp_);
    if (options_.skip_existing && all_exist(planned)) {
      log::info("{}{}: skipped, {} exists", batch_.label(), file_, planned[0]);
      return false;
    }
    check_outputs(planned);
    build();
    if (interrupt_exit_code() != 0) {
      log::warning("{}: interrupted before the first sample; there is no image", file_);
      return false;
    }
    decide();
    record_.noise_only = integrator_->blurs() || !record_.bias.empty();
    check_memory(layout_, *integrator_, request_.budget);
    const RenderResult result = render_with_progress();
    seconds_.render = watch_.lap();
    write(result);
    seconds_.write = watch_.lap();
    statistics_.add(record_, result, seconds_, count(*scene_));
    summarize(result);
    return true;
  }

 private:
  void read() {
    description_ = load_scene(file_, options_.read).description;
    seconds_.parse = watch_.lap();
    if (log::level() == log::Level::verbose)
      log::detail("{}: {}", file_, describe(scene_features(description_)));
  }

  /// Everything that can be wrong with the command line for this scene shows here.
  void prepare() {
    const size_t sensors = description_.sensors.size();
    if (options_.sensor >= sensors)
      throw UsageError(fmt::format("-s {}: {} has {} sensor{}", options_.sensor, file_, sensors,
                                   sensors == 1 ? "" : "s"));
    SensorDescription& sensor = description_.sensors[options_.sensor];
    layout_ = film_layout(sensor.film, options_.size, options_.crop);
    try {
      apply_override(description_.integrator, options_.integrator);
      integrator_ = make_integrator(description_.integrator, options_.techniques);
    } catch (const std::invalid_argument& e) {
      throw UsageError(e.what());
    }
    Diagnostics diagnostics;
    check_support(description_, description_.integrator, diagnostics);
    check_support(sensor, description_.integrator, diagnostics);
    report(diagnostics, options_.read.strict);
    if (const std::string bias = integrator_->bias(); !bias.empty()) warn(bias);
    record_.bias = integrator_->bias();
    view_ = sensor;
    // One place stands for all that a moving sensor passes.
    if (!sensor.motion.empty())
      view_.to_world = sensor.motion.at(sensor.shutter[0]) * sensor.to_world;
    make_request(sensor.sampler);
    planned_spp_ = request_.budget.spp.value_or(sensor.sampler.sample_count);

    record_.scene_file = file_;
    record_.scene_hash = hash_file(file_);
    record_.integrator = integrator_name(description_.integrator);
    record_.integrator_parameters = integrator_parameters(description_.integrator);
    record_.sampler = request_.sequence == SampleSequence::sobol ? "sobol" : "independent";
    record_.seed = request_.seed;
    record_.threads = request_.threads;
  }

  void make_request(const SamplerDescription& sampler) {
    request_.budget = options_.budget;
    if (!request_.budget.spp && !request_.budget.seconds && !request_.budget.target_error)
      request_.budget.spp = sampler.sample_count;
    if (request_.budget.target_error && !has_colours())
      throw UsageError("--target-error: the image has layers only, no colours to estimate it from");
    request_.seed = options_.seed.value_or(sampler.seed);
    request_.threads = options_.threads;
    request_.sequence = SampleSequence::sobol;
    if (options_.strict_sampler && sampler.name == "independent")
      request_.sequence = SampleSequence::independent;
    else if (options_.strict_sampler && sampler.name != "sobol")
      warn(fmt::format("the sampler \"{}\" is not available; Owen-scrambled Sobol' points are used",
                       sampler.name));
    request_.cancel = &interrupt_flag();
  }

  bool has_colours() const { return integrator_->channels()[0] == "R"; }

  /// A warning that --strict makes an error.
  void warn(const std::string& text) const {
    if (options_.read.strict) throw SceneFailure(text + " (an error because of --strict)");
    log::warning("{}: {}", file_, text);
  }

  /// The images' names if they have this many samples.
  std::vector<std::string> paths(int spp) const {
    OutputNames names = output_names(file_);
    names.integrator = record_.integrator;
    names.spp = fmt::to_string(spp);
    names.seed = fmt::to_string(record_.seed);
    std::vector<std::string> result;
    for (const std::string& pattern : options_.outputs)
      result.push_back(output_path(pattern, names, options_.extension));
    if (result.empty()) result.push_back(output_path("", names, options_.extension));
    return result;
  }

  static bool all_exist(const std::vector<std::string>& paths) {
    std::error_code ignored;
    for (const std::string& p : paths)
      if (!std::filesystem::exists(p, ignored)) return false;
    return true;
  }

  /// Finds out before rendering what would be a pity to find out afterwards.
  void check_outputs(const std::vector<std::string>& planned) const {
    for (const std::string& path : planned) {
      if (const std::string why = prepare_file(path); !why.empty())
        throw SceneFailure(fmt::format("cannot write {}: {}", path, why));
      if (is_display_format(path) && !has_colours())
        throw UsageError(
            fmt::format("-o {}: the image has layers only, which .exr files can hold", path));
    }
  }

  void build() {
    BuildOptions build;
    build.sensor = options_.sensor;
    build.threads = options_.threads;
    build.layer_needs = integrator_needs(description_.integrator);
    Diagnostics diagnostics;
    scene_ = build_scene(std::move(description_), build, diagnostics);
    report(diagnostics, options_.read.strict);
    seconds_.build = watch_.lap();
    log::detail("{}: read in {:.2f} s, built in {:.2f} s", file_, seconds_.parse, seconds_.build);
  }

  /// Lets a method that chooses another one do so.
  void decide() {
    integrator_->begin(*scene_, {layout_.full, planned_spp_, options_.threads});
    const MethodDecision* decision = integrator_->decision();
    if (!decision) return;
    record_.decision = *decision;
    record_.bias = integrator_->bias();
    log::info("{}: auto chose {}", file_, decision->reason);
  }

  RenderResult render_with_progress() {
    ProgressDisplay display(options_.progress,
                            batch_.is_several() ? output_names(file_).scene : file_, batch_);
    request_.progress = [&](const RenderProgress& p) { display.show(p); };
    return render(*scene_, *integrator_, layout_, request_);
  }

  void write(const RenderResult& result) const {
    ExrOptions exr;
    exr.half = view_.film.component_format == ComponentFormat::half;
    exr.origin = {layout_.crop.x0, layout_.crop.y0};
    exr.full_size = layout_.full;
    exr.header = image_header(record_, result, view_, layout_.full);
    const DisplayOptions display{options_.exposure, view_.film.tone_mapping};
    std::string failures;
    for (const std::string& path : paths(result.spp)) {
      try {
        write_image(path, result.image, view_.film.pixel_format, exr, display);
      } catch (const std::exception& e) {
        failures += (failures.empty() ? "" : "; ") + std::string(e.what());
      }
    }
    if (!failures.empty()) throw SceneFailure(failures);
  }

  void summarize(const RenderResult& r) const {
    std::string text =
        fmt::format("{}{}: {}{} spp in {}", batch_.label(), file_,
                    r.interrupted ? "interrupted, " : "", r.spp, format_seconds(r.seconds));
    if (r.relative_rmse)
      text +=
          fmt::format(", estimated relative error {}{}{}", r.rmse_is_upper_bound ? "below " : "",
                      percent(*r.relative_rmse), record_.noise_only ? " (noise only)" : "");
    for (const std::string& p : paths(r.spp)) text += " -> " + p;
    log::info("{}", text);
    if (request_.budget.target_error && !r.relative_rmse && !r.interrupted)
      warn("the image is black: there is no relative error for --target-error");
    if (r.counters.nonfinite_samples > 0)
      warn(fmt::format("{} of {} samples were not finite and count as black",
                       r.counters.nonfinite_samples, r.counters.camera_paths));
  }

  const std::string& file_;
  const RenderOptions& options_;
  const Batch& batch_;
  StatisticsFile& statistics_;
  Stopwatch watch_;
  PhaseSeconds seconds_;
  SceneDescription description_;
  SensorDescription view_;
  FilmLayout layout_;
  RenderRequest request_;
  RenderRecord record_;
  int planned_spp_ = 0;
  std::unique_ptr<Integrator> integrator_;
  std::unique_ptr<Scene> scene_;
};

}  // namespace

bool render_scene(const std::string& file, const RenderOptions& options, const Batch& batch,
                  StatisticsFile& statistics) {
  return SceneRenderer(file, options, batch, statistics).run();
}

}  // namespace duet
