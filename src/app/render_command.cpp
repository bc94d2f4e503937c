// duet render: scenes in, images out.
#include <CLI/CLI.hpp>

#include "app/commands.h"
#include "app/render_options.h"
#include "app/render_scene.h"
#include "app/signals.h"
#include "app/statistics.h"
#include "base/log.h"

namespace duet {

namespace {

/// Renders the scenes of one call, one after the other.
class RenderCommand {
 public:
  explicit RenderCommand(RenderOptions options)
      : options_(std::move(options)), statistics_(options_.stats_file) {}

  int run() {
    install_signal_handlers();
    set_up_log();
    check_defines(options_.read);
    for (const std::string& file : options_.read.scenes) {
      if (interrupt_exit_code() != 0) break;
      if (failed_ > 0 && !options_.keep_going) break;
      render(file);
      ++tried_;
    }
    const size_t scenes = options_.read.scenes.size();
    const bool has_statistics = write_statistics(scenes > 1);
    if (tried_ < scenes) log::warning("{} of {} scenes were not tried", scenes - tried_, scenes);
    if (failed_ > 0 && scenes > 1) log::error("{} of {} scenes failed", failed_, scenes);
    if (const int code = interrupt_exit_code()) return code;
    // What no scene has is asked for by mistake; what some have not is missing there.
    if (failed_ > 0 && misused_ == scenes) return kWrongUsage;
    if (failed_ > 0 || !has_statistics) return kSceneFailed;
    return options_.require_target && missed_ > 0 ? kTargetMissed : kSuccess;
  }

 private:
  void set_up_log() const {
    log::set_level(options_.quiet     ? log::Level::quiet
                   : options_.verbose ? log::Level::verbose
                                      : log::Level::normal);
    if (options_.log_file.empty()) return;
    try {
      log::open_file(options_.log_file);
    } catch (const std::exception& e) {
      throw UsageError(fmt::format("--log: {}", e.what()));
    }
  }

  /// Whether the statistics are where they should be.
  bool write_statistics(bool several) const {
    if (options_.stats_file.empty()) return true;
    try {
      statistics_.write(several);
      return true;
    } catch (const std::exception& e) {
      log::error("--stats: {}", e.what());
      return false;
    }
  }

  void render(const std::string& file) {
    const log::Recording messages;
    try {
      missed_ += render_scene(file, options_, statistics_) == RenderOutcome::target_missed;
      return;
    } catch (const UsageError& e) {
      log::error("{}: {}", file, e.what());
      ++misused_;
    } catch (const SceneFailure& e) {
      if (*e.what() != '\0') log::error("{}: {}", file, e.what());
    } catch (const std::bad_alloc&) {
      log::error("{}: out of memory", file);
    } catch (const std::exception& e) {
      log::error("{}: {}", file, e.what());
    }
    ++failed_;
    statistics_.add_failure(file, messages.lines(), false);
  }

  RenderOptions options_;
  StatisticsFile statistics_;
  size_t tried_ = 0, failed_ = 0;
  size_t missed_ = 0;   ///< whose error is above --target-error
  size_t misused_ = 0;  ///< of the failed: the command line did not fit the scene
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
      "  duet room.xml -i path -I max_depth=4 --aov albedo,normal --crop 100,100,64,64\n"
      "Exit codes: 0 all rendered; 1 a scene failed, the others were rendered; 2 wrong usage;\n"
      "4 --target-error was not met and --require-target was given; 129, 130 or 143 interrupted "
      "by\n"
      "SIGHUP, Ctrl-C or SIGTERM: the samples so far are in SCENE.partial.exr, if every pixel has "
      "one.\n"
      "SIGUSR1 writes that file and goes on.");
  c->callback([parser, &exit_code] { exit_code = RenderCommand(parser->finish()).run(); });
}

}  // namespace duet
