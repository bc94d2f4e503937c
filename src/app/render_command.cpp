// duet render: scenes in, images out.
#include <chrono>
#include <filesystem>
#include <set>

#include "app/commands.h"
#include "app/header.h"
#include "app/output.h"
#include "app/render_options.h"
#include "app/signals.h"
#include "app/statistics.h"
#include "base/log.h"
#include "scene/build.h"

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

/// The scene cannot be rendered as asked; what is wrong has been printed or is in the message.
class SceneFailure : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Renders the scenes of one call, one after the other.
class RenderCommand {
 public:
  explicit RenderCommand(RenderOptions options)
      : options_(std::move(options)), statistics_(options_.stats_file) {}

  int run() {
    log::set_level(options_.quiet     ? log::Level::quiet
                   : options_.verbose ? log::Level::verbose
                                      : log::Level::normal);
    if (!options_.log_file.empty()) {
      try {
        log::open_file(options_.log_file);
      } catch (const std::exception& e) {
        throw UsageError(fmt::format("--log: {}", e.what()));
      }
    }
    install_signal_handlers();
    bool failed = false;
    for (const std::string& file : options_.scenes) {
      if (interrupt_exit_code() != 0) break;
      try {
        render_scene(file);
      } catch (const UsageError&) {
        throw;
      } catch (const SceneFailure& e) {
        if (*e.what() != '\0') log::error("{}: {}", file, e.what());
        failed = true;
      } catch (const std::bad_alloc&) {
        log::error("{}: out of memory", file);
        failed = true;
      } catch (const std::exception& e) {
        log::error("{}: {}", file, e.what());
        failed = true;
      }
      if (failed && !options_.keep_going) break;
    }
    check_defines(failed);
    if (!options_.stats_file.empty()) statistics_.write(options_.scenes.size() > 1);
    if (const int code = interrupt_exit_code()) return code;
    return failed ? kSceneFailed : kSuccess;
  }

 private:
  /// A define that no scene of the call has a use for is a slip of the pen; but scenes that could
  /// not be read may have had one.
  void check_defines(bool failed) const {
    for (const std::string& define : options_.read.defines) {
      const std::string name = define.substr(0, define.find('='));
      if (failed || parameters_.contains(name)) continue;
      std::string known;
      for (const std::string& p : parameters_) known += (known.empty() ? "" : ", ") + p;
      throw UsageError(fmt::format("-D {}: no scene has a parameter ${}{}", define, name,
                                   known.empty() ? "; there are none" : "; there are " + known));
    }
  }

  void render_scene(const std::string& file) {
    PhaseSeconds seconds;
    Stopwatch watch;
    auto scene_file = load_scene(file, options_.read);
    if (!scene_file) throw SceneFailure("");
    for (const auto& [name, value] : scene_file->parameters) parameters_.insert(name);
    SceneDescription& description = scene_file->description;
    seconds.parse = watch.lap();

    if (options_.sensor >= description.sensors.size())
      throw UsageError(fmt::format("-s {}: {} has {} sensor{}", options_.sensor, file,
                                   description.sensors.size(),
                                   description.sensors.size() == 1 ? "" : "s"));
    SensorDescription& sensor = description.sensors[options_.sensor];
    try {
      apply_override(description.integrator, options_.integrator);
      integrator_ = make_integrator(description.integrator);
    } catch (const std::invalid_argument& e) {
      throw UsageError(e.what());
    }
    const FilmLayout layout = film_layout(sensor.film);
    RenderRequest request = render_request(sensor.sampler);

    OutputNames names;
    names.scene = std::filesystem::path(file).stem().string();
    names.integrator = integrator_name(description.integrator);
    names.spp = request.budget.spp.value_or(sensor.sampler.sample_count);
    names.seed = request.seed;
    const std::vector<std::string> paths = output_paths(names);
    if (options_.skip_existing && all_exist(paths)) {
      log::info("{}: skipped, {} exists", file, paths[0]);
      return;
    }
    for (const std::string& path : paths)
      if (const std::string why = unwritable_reason(path); !why.empty())
        throw SceneFailure(fmt::format("cannot write {}: {}", path, why));

    RenderRecord record;
    record.scene_file = file;
    record.scene_hash = hash_file(file);
    record.integrator = names.integrator;
    record.integrator_parameters = integrator_parameters(description.integrator);
    record.sampler = request.sequence == SampleSequence::sobol ? "sobol" : "independent";
    record.seed = request.seed;
    record.threads = request.threads;
    const SensorDescription view = sensor;

    BuildOptions build;
    build.sensor = options_.sensor;
    build.threads = options_.threads;
    build.layer_needs = integrator_needs(description.integrator);
    Diagnostics diagnostics;
    size_t printed = 0;
    const std::unique_ptr<Scene> scene = build_scene(std::move(description), build, diagnostics);
    if (report(diagnostics, options_.read.strict, printed) || !scene) throw SceneFailure("");
    seconds.build = watch.lap();
    log::detail("{}: read in {:.2f} s, built in {:.2f} s", file, seconds.parse, seconds.build);
    if (interrupt_exit_code() != 0) return;

    const RenderResult result = render_with_progress(*scene, layout, request, file);
    seconds.render = watch.lap();
    write(paths, result, record, view, layout);
    seconds.write = watch.lap();
    statistics_.add(record, result, seconds, count(*scene));
    summarize(file, result, paths);
  }

  FilmLayout film_layout(FilmDescription& film) const {
    if (options_.size) {
      film.width = options_.size->x, film.height = options_.size->y;
      film.crop.reset();
    }
    PixelBounds crop{0, 0, film.width, film.height};
    if (film.crop)
      crop = {film.crop->x, film.crop->y, film.crop->x + film.crop->width,
              film.crop->y + film.crop->height};
    if (options_.crop) {
      crop = *options_.crop;
      if (crop.x1 > film.width || crop.y1 > film.height)
        throw UsageError(fmt::format("--crop: the window reaches beyond the image of {}x{}",
                                     film.width, film.height));
    }
    return {{film.width, film.height}, crop, film.filter};
  }

  RenderRequest render_request(const SamplerDescription& sampler) const {
    RenderRequest request;
    request.budget = options_.budget;
    if (!request.budget.spp && !request.budget.seconds && !request.budget.target_error)
      request.budget.spp = sampler.sample_count;
    request.seed = options_.seed.value_or(sampler.seed);
    request.threads = options_.threads;
    request.sequence = SampleSequence::sobol;
    if (options_.strict_sampler) {
      if (sampler.name == "independent")
        request.sequence = SampleSequence::independent;
      else if (sampler.name != "sobol")
        log::warning(
            "--strict-sampler: \"{}\" is not available; Owen-scrambled Sobol' points are used",
            sampler.name);
    }
    request.cancel = &interrupt_flag();
    return request;
  }

  std::vector<std::string> output_paths(const OutputNames& names) const {
    std::vector<std::string> paths;
    for (const std::string& pattern : options_.outputs)
      paths.push_back(output_path(pattern, names));
    if (paths.empty()) paths.push_back(output_path("", names));
    return paths;
  }

  static bool all_exist(const std::vector<std::string>& paths) {
    std::error_code ignored;
    for (const std::string& p : paths)
      if (!std::filesystem::exists(p, ignored)) return false;
    return true;
  }

  RenderResult render_with_progress(const Scene& scene, const FilmLayout& layout,
                                    RenderRequest request, const std::string& file) const {
    ProgressDisplay display(options_.progress, file);
    request.progress = [&](const RenderProgress& p) { display.show(p); };
    return render(scene, *integrator_, layout, request);
  }

  void write(const std::vector<std::string>& paths, const RenderResult& result,
             const RenderRecord& record, const SensorDescription& view,
             const FilmLayout& layout) const {
    ExrOptions exr;
    exr.half = view.film.component_format == ComponentFormat::half;
    exr.origin = {layout.crop.x0, layout.crop.y0};
    exr.full_size = layout.full;
    exr.header = image_header(record, result, view, layout.full);
    const DisplayOptions display{options_.exposure, view.film.tone_mapping};
    const Image image = in_pixel_format(result.image, view.film.pixel_format);
    std::string failures;
    for (const std::string& path : paths) {
      try {
        write_image(path, image, exr, display);
      } catch (const std::exception& e) {
        failures += (failures.empty() ? "" : "; ") + std::string(e.what());
      }
    }
    if (!failures.empty()) throw SceneFailure(failures);
  }

  static SceneCounts count(const Scene& scene) {
    SceneCounts n;
    n.emitters = scene.lights.size();
    n.instances = scene.instances.size();
    for (const Shape& s : scene.shapes) n.triangles += s.mesh ? s.mesh->triangles.size() : 0;
    return n;
  }

  static void summarize(const std::string& file, const RenderResult& r,
                        const std::vector<std::string>& paths) {
    std::string text = fmt::format("{}: {}{} spp in {}", file, r.interrupted ? "interrupted, " : "",
                                   r.spp, format_seconds(r.seconds));
    if (r.relative_rmse)
      text += fmt::format(", estimated relative error {}{:.2g} %",
                          r.rmse_is_upper_bound ? "below " : "", 100 * *r.relative_rmse);
    for (const std::string& p : paths) text += " -> " + p;
    log::info("{}", text);
    if (r.counters.nonfinite_samples > 0)
      log::warning("{}: {} of {} samples were not finite and count as black", file,
                   r.counters.nonfinite_samples, r.counters.camera_paths);
  }

  RenderOptions options_;
  StatisticsFile statistics_;
  std::set<std::string> parameters_;
  std::unique_ptr<Integrator> integrator_;
};

}  // namespace

void add_render_command(CLI::App& app, int& exit_code) {
  CLI::App* c = app.add_subcommand("render", "Render scenes to images");
  const auto parser = std::make_shared<RenderOptionParser>(*c);
  c->footer(
      "Examples:\n"
      "  duet cornell.xml                          cornell.exr, as the scene says\n"
      "  duet cornell.xml --spp 256 -o out.png     another number of samples, for display\n"
      "  duet *.xml -o 'images/{scene}-{spp}.exr'  a batch\n"
      "  duet room.xml --target-error 1% -v        until the estimated error is below 1 %\n"
      "  duet room.xml -i path -I max_depth=4 --aov albedo,normal --crop 100,100,64,64");
  c->callback([parser, &exit_code] { exit_code = RenderCommand(parser->finish()).run(); });
}

}  // namespace duet
