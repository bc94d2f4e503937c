// duet chart: error against time for several methods.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>

#include "app/chart_options.h"
#include "app/commands.h"
#include "app/program.h"
#include "base/system/signals.h"
#include "evaluate/chart/page.h"
#include "evaluate/compare/linear_image.h"
#include "evaluate/render/output.h"
#include "evaluate/render/placeholders.h"
#include "evaluate/render/scene_operand.h"

namespace duet {

namespace fs = std::filesystem;

namespace {

/// The charts of one call, one scene after the other.
class ChartCommand {
 public:
  ChartCommand(ChartOptions options, Program& program)
      : o_(std::move(options)), program_(program), log_(program.log) {}

  int run() {
    log_.set_level(o_.quiet ? Log::Level::quiet : Log::Level::normal);
    o_.read.standard_input = read_standard_input(o_.read.scenes);
    check_defines(o_.read);
    install_signal_handlers();
    const std::vector<std::string> names = chart_names(o_.read.scenes);
    make_directory(o_.directory);
    for (size_t i = 0; i < names.size() && interrupt_exit_code() == 0; ++i) measure(i, names[i]);
    if (several() && !scenes_.empty())
      log_.info("{}", write_chart_index(scenes_, o_.directory, program_.command_line));
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
      ChartScene scene = measure_chart(plan(index, name, directory), messages());
      if (scene.lines.empty()) return;  // interrupted
      write(scene, directory);
      for (const ChartLine& line : scene.lines) failed_ += line.failure.empty() ? 0 : 1;
      scenes_.push_back(std::move(scene));
      return;
    } catch (const UsageError& e) {
      log_.error("{}: {}", file, e.what());
      ++misused_;
    } catch (const ChartMethodError& e) {
      log_.error("{}: {}", file, e.what());
      ++misused_;
    } catch (const SceneFailure& e) {
      if (!e.is_printed()) log_.error("{}: {}", file, e.what());
    } catch (const std::exception& e) {
      log_.error("{}: {}", file, e.what());
    }
    ++failed_;
  }

  ChartMessages messages() const {
    return {[this](const std::string& text) { log_.info("{}", text); },
            [this](const std::string& text) { log_.warning("{}", text); },
            [this](const Diagnostics& diagnostics) { report(diagnostics, o_.read.strict, log_); }};
  }

  ChartPlan plan(size_t index, const std::string& name, const std::string& directory) const {
    ChartPlan p;
    p.name = name;
    p.file = o_.read.scenes[index];
    p.description = load_scene(p.file, o_.read, log_).description;
    if (const size_t n = p.description.sensors.size(); o_.sensor >= n)
      throw UsageError(fmt::format("-s {}: there {} sensor{}", o_.sensor,
                                   n == 1 ? "is 1" : fmt::format("are {}", n), n == 1 ? "" : "s"));
    p.sensor = o_.sensor;
    p.size = o_.size;
    p.methods = o_.methods;
    for (const auto& [external, command] : o_.external)
      p.external.push_back({external, command, external_command(command)});
    if (!o_.references.empty())
      p.reference = reference(index);
    else if (!o_.reference_integrator.empty())
      p.reference_method = reference_method();
    p.directory = directory;
    p.command_line = program_.command_line;
    p.seconds = o_.seconds;
    p.seed = o_.seed;
    p.threads = o_.threads;
    p.cancel = &interrupt_flag();
    return p;
  }

  ChartReference reference(size_t index) const {
    try {
      return read_reference(path_of("--reference", o_.references, index),
                            o_.variances.empty() ? "" : path_of("--variance", o_.variances, index),
                            o_.reference_spp);
    } catch (const UnknownSamples& e) {
      throw UsageError(fmt::format(
          "--variance also needs --reference-spp: the header of {} does not say how many samples "
          "it has",
          e.path()));
    }
  }

  ChartMethod reference_method() const {
    const std::vector<ChartMethod> methods = parse_methods(o_.reference_integrator);
    if (methods.size() != 1) throw UsageError("--reference-integrator: one method is needed");
    return methods[0];
  }

  /// A path that belongs to a scene; one for all has placeholders.
  std::string path_of(const char* option, const std::vector<std::string>& given,
                      size_t index) const {
    const OutputNames names = output_names(o_.read.scenes[index]);
    return fill_in(option, given.size() == 1 ? given[0] : given[index],
                   {{"scene", names.scene}, {"folder", names.folder}});
  }

  void write(const ChartScene& scene, const std::string& directory) const {
    write_chart(scene, directory, program_.command_line);
    for (const ChartLine& line : scene.lines) log_.info("{}", line_summary(scene, line));
    log_.info("{}: {}", scene.name, in(directory, "index.html"));
  }

  ChartOptions o_;
  Program& program_;
  Log& log_;
  std::vector<ChartScene> scenes_;
  size_t failed_ = 0, misused_ = 0;
};

}  // namespace

void add_chart_command(CLI::App& app, Program& program) {
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
  c->callback([parser, &program] {
    program.exit_code = ChartCommand(parser->finish(program.threads()), program).run();
  });
}

}  // namespace duet
