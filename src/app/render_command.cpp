// duet render: scenes in, images out.
#include <CLI/CLI.hpp>
#include <filesystem>

#include "app/commands.h"
#include "app/program.h"
#include "app/render_options.h"
#include "base/system/signals.h"
#include "evaluate/render/output.h"
#include "evaluate/render/render_scene.h"
#include "evaluate/render/scene_operand.h"
#include "evaluate/report/statistics.h"

namespace duet {

namespace {

/// Renders the scenes of one call, one after the other.
class RenderCommand {
 public:
  RenderCommand(RenderCommandLine options, Program& program)
      : options_(std::move(options)),
        program_(program),
        log_(program.log),
        statistics_(options_.stats_file),
        batch_(options_.read.scenes.size()) {}

  int run() {
    install_signal_handlers();
    set_up_log();
    options_.read.standard_input = read_standard_input(options_.read.scenes);
    check_defines(options_.read);
    open_page();
    for (const std::string& file : options_.read.scenes) {
      if (interrupt_exit_code() != 0) break;
      if (!failures_.empty() && !options_.keep_going) break;
      batch_.begin_scene();
      const bool rendered = render(file);
      batch_.end_scene(rendered);
      ++tried_;
    }
    const size_t scenes = options_.read.scenes.size();
    const bool has_statistics = write_statistics();
    if (tried_ < scenes) log_.warning("{} of {} scenes were not tried", scenes - tried_, scenes);
    if (batch_.is_several()) list_failures();
    if (const int code = interrupt_exit_code()) return code;
    // What no scene has is asked for by mistake; what some have not is missing there.
    if (!failures_.empty() && misused_ == scenes) return kWrongUsage;
    if (!failures_.empty() || !has_statistics) return kSceneFailed;
    return options_.require_target && missed_ > 0 ? kTargetMissed : kSuccess;
  }

 private:
  void set_up_log() const {
    log_.set_level(message_level(options_.quiet, options_.verbose));
    if (options_.log_file.empty()) return;
    std::error_code ignored;  // the file says what is wrong
    make_directories(std::filesystem::path(options_.log_file).parent_path(), ignored);
    try {
      log_.open_file(options_.log_file);
    } catch (const std::exception& e) {
      throw UsageError(fmt::format("--log: {}", e.what()));
    }
  }

  void open_page() {
    if (!options_.live_port) return;
    try {
      page_.emplace(*options_.live_port);
    } catch (const std::system_error& e) {
      throw UsageError(fmt::format("--live: port {}: {}", *options_.live_port, e.what()));
    }
    log_.info("the image as it grows: {}", page_->url());
  }

  /// Whether the statistics are where they should be.
  bool write_statistics() const {
    if (options_.stats_file.empty()) return true;
    try {
      statistics_.write(batch_.is_several());
      return true;
    } catch (const std::exception& e) {
      log_.error("--stats: {}", e.what());
      return false;
    }
  }

  /// Whether the scene was rendered and nothing failed.
  bool render(const std::string& file) {
    const Log::Recording messages(log_);
    try {
      const RenderCall call{batch_,
                            statistics_,
                            program_.command_line,
                            options_.uses,
                            log_,
                            [&](const std::string& scene) { return progress_of(scene); },
                            interrupt_flag(),
                            take_snapshot_request,
                            page_ ? &*page_ : nullptr};
      const RenderOutcome outcome = render_scene(file, options_, call);
      missed_ +=
          outcome == RenderOutcome::target_missed || outcome == RenderOutcome::kept_target_missed;
      return outcome == RenderOutcome::rendered || outcome == RenderOutcome::target_missed;
    } catch (const UsageError& e) {
      ++misused_;
      fail(file, e.what());
    } catch (const SceneFailure& e) {
      fail(file, e.what(), e.is_printed());
    } catch (const std::bad_alloc&) {
      fail(file, "out of memory");
    } catch (const std::exception& e) {
      fail(file, e.what());
    }
    statistics_.add_failure(file, messages.lines(), false);
    return false;
  }

  ShowProgress progress_of(const std::string& scene) const {
    const auto display = std::make_shared<ProgressDisplay>(options_.progress, scene, batch_, log_);
    return [display](const RenderProgress& p) { display->show(p); };
  }

  void fail(const std::string& file, const std::string& reason, bool is_printed = false) {
    if (!is_printed) log_.error("{}: {}", file, reason);
    // Reasons that are places in the file begin with its name.
    failures_.push_back(reason.starts_with(file + ":") ? reason : file + ": " + reason);
  }

  void list_failures() const {
    if (failures_.empty()) return;
    log_.error("{} of {} scenes failed:", failures_.size(), options_.read.scenes.size());
    for (const std::string& failure : failures_) log_.write(Log::Level::quiet, "  " + failure);
  }

  RenderCommandLine options_;
  Program& program_;
  Log& log_;
  StatisticsFile statistics_;
  Batch batch_;
  std::optional<LivePage> page_;  ///< --live
  size_t tried_ = 0;
  std::vector<std::string> failures_;  ///< each a scene and the first reason
  size_t missed_ = 0;                  ///< whose error is above --target-error
  size_t misused_ = 0;                 ///< of the failed: the command line did not fit the scene
};

}  // namespace

void add_render_command(CLI::App& app, Program& program) {
  CLI::App* c = app.add_subcommand("render", "Render scenes to images");
  const auto parser = std::make_shared<RenderOptionParser>(*c, program);
  c->footer(
      "{scene} is the name of the scene file; that of a scene.xml is the name of its folder. {{ "
      "means a brace.\n"
      "Examples:\n"
      "  duet cornell.xml                          cornell.exr, as the scene says\n"
      "  duet scenes/kitchen                       kitchen.exr from its scene.xml\n"
      "  duet cornell.xml --spp 256 -o out.png     more samples, for display\n"
      "  duet *.xml -o 'images/{scene}-{spp}.exr'  a batch\n"
      "  duet - -o - --format png < a.xml | view   from and to other programs\n"
      "  duet room.xml --target-error 1% -v        until the error is about 1 %\n"
      "  duet room.xml -i path -I max_depth=4 --aov albedo,normal --crop 100,100,64,64\n"
      "Exit codes: 0 all rendered; 1 a scene failed, the others were rendered; 2 wrong usage; "
      "4 --target-error was not met and --require-target was given; 129, 130 or 143 interrupted by "
      "SIGHUP, Ctrl-C or SIGTERM: the samples so far are in SCENE.partial.exr, if every pixel has "
      "one. SIGUSR1 writes that file and goes on.");
  c->callback(
      [parser, &program] { program.exit_code = RenderCommand(parser->finish(), program).run(); });
}

}  // namespace duet
