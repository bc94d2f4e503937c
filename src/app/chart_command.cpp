// duet chart: error against time for several methods.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <filesystem>

#include "app/chart_options.h"
#include "app/chart_page.h"
#include "app/chart_scene.h"
#include "app/chart_svg.h"
#include "app/commands.h"
#include "app/progress.h"
#include "app/render_scene.h"
#include "app/scene_operand.h"
#include "app/signals.h"
#include "app/web_page.h"
#include "base/log.h"
#include "base/percent.h"

namespace duet {

namespace fs = std::filesystem;

namespace {

/// The charts of one call, one scene after the other.
class ChartCommand {
 public:
  explicit ChartCommand(ChartOptions options) : o_(std::move(options)) {}

  int run() {
    log::set_level(o_.quiet ? log::Level::quiet : log::Level::normal);
    read_standard_input(o_.read.scenes);
    check_defines(o_.read);
    install_signal_handlers();
    const std::vector<std::string> names = chart_names(o_.read.scenes);
    make_directory(o_.directory);
    for (size_t i = 0; i < names.size() && interrupt_exit_code() == 0; ++i) measure(i, names[i]);
    if (several() && !scenes_.empty()) {
      write_text(in(o_.directory, "summary.csv"), summary_csv(scenes_));
      write_text(in(o_.directory, "index.html"), chart_index(scenes_));
      log::info("{}", in(o_.directory, "index.html"));
    }
    if (const int code = interrupt_exit_code()) return code;
    if (misused_ == names.size()) return kWrongUsage;
    return failed_ > 0 ? kSceneFailed : kSuccess;
  }

 private:
  static std::string in(const std::string& directory, const std::string& name) {
    return (fs::path(directory) / name).string();
  }

  bool several() const { return o_.read.scenes.size() > 1; }

  static void make_directory(const std::string& path) {
    std::error_code error;
    fs::create_directories(path, error);
    if (!fs::is_directory(path))
      throw UsageError(fmt::format("-o {}: cannot be made a directory", path));
  }

  void measure(size_t index, const std::string& name) {
    const std::string& file = o_.read.scenes[index];
    const std::string directory = several() ? in(o_.directory, name) : o_.directory;
    try {
      make_directory(directory);
      ChartScene scene = measure_scene(o_, index, name, directory);
      if (scene.lines.empty()) return;  // interrupted
      write(scene, directory);
      for (const ChartLine& line : scene.lines) failed_ += line.failure.empty() ? 0 : 1;
      scenes_.push_back(std::move(scene));
      return;
    } catch (const UsageError& e) {
      log::error("{}: {}", file, e.what());
      ++misused_;
    } catch (const SceneFailure& e) {
      if (!e.is_printed()) log::error("{}: {}", file, e.what());
    } catch (const std::exception& e) {
      log::error("{}: {}", file, e.what());
    }
    ++failed_;
  }

  void write(const ChartScene& scene, const std::string& directory) const {
    write_text(in(directory, "chart.csv"), chart_csv(scene));
    write_text(in(directory, "chart.svg"), chart_svg(scene, ChartAxis::cpu_seconds));
    write_text(in(directory, "chart-spp.svg"), chart_svg(scene, ChartAxis::spp));
    write_text(in(directory, "index.html"), chart_page(scene));
    for (const ChartLine& line : scene.lines) summarize(scene, line);
    log::info("{}: {}", scene.name, in(directory, "index.html"));
  }

  static void summarize(const ChartScene& scene, const ChartLine& line) {
    if (line.points.empty()) return log::info("{}: {}: no image", scene.name, line.name);
    const ChartPoint& p = line.points.back();
    const auto e = efficiency(line);
    const std::string slope =
        line.by_time.slope ? fmt::format(", slope {:.2f}", line.by_time.slope->slope) : "";
    log::info(
        "{}: {}: {} spp in {:.3g} CPU s, {}", scene.name, line.name, p.spp, p.cpu_seconds,
        e ? fmt::format("root of the trimmed relMSE {}, {:.2f} of the best efficiency{}",
                        percent(std::sqrt(p.trimmed)), e->value / best_efficiency(scene), slope)
          : "error below the reference's noise");
  }

  ChartOptions o_;
  std::vector<ChartScene> scenes_;
  size_t failed_ = 0, misused_ = 0;
};

}  // namespace

void add_chart_command(CLI::App& app, int& exit_code) {
  CLI::App* c = app.add_subcommand("chart", "Chart error against time for several methods");
  const auto parser = std::make_shared<ChartOptionParser>(*c);
  c->footer(
      "Methods take turns in short slices until the time is used up. Errors are against the "
      "reference, with its own variance subtracted if --variance says what it is. Open index.html "
      "in a browser; it needs no network. Several scenes get a directory each, and a table of all "
      "of them.\n"
      "Examples:\n"
      "  duet chart room.xml --reference room.exr -o charts\n"
      "  duet chart room.xml -i path,bdpt,vcm:radius=0.01,alpha=0.7 -I max_depth=8 --time 5m\n"
      "  duet chart scenes/*/scene.xml --reference 'reference/{folder}/mean.exr' --variance "
      "'reference/{folder}/variance.exr'\n"
      "  duet chart room.xml --external 'mitsuba=mitsuba {scene} -D spp={spp} -o {out}'\n"
      "Exit codes: 0; 1 a scene or an external renderer failed; 2 wrong usage; 130 or 143 "
      "interrupted, files written with what there was.");
  c->callback([parser, &exit_code] { exit_code = ChartCommand(parser->finish()).run(); });
}

}  // namespace duet
