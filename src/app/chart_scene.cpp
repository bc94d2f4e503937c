#include "app/chart_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "app/chart_reference.h"
#include "app/commands.h"
#include "app/film_layout.h"
#include "app/render_scene.h"
#include "app/signals.h"
#include "base/log.h"
#include "base/percent.h"
#include "scene/build.h"

namespace duet {

namespace {

/// Nobody has more than this share of his time at once, so that all see the same machine.
constexpr double kSliceShare = 1.0 / 32;
/// The share of a scene's time in which a reference is made if there is none.
constexpr double kReferenceShare = 0.5;
constexpr double kSecondsBetweenLines = 5;

class SceneChart {
 public:
  SceneChart(const ChartOptions& options, size_t index, const std::string& name,
             const std::string& directory)
      : o_(options), index_(index), directory_(directory) {
    chart_.name = name;
    chart_.file = options.read.scenes[index];
    chart_.threads = options.threads;
    chart_.seconds = options.seconds;
  }

  ChartScene run() {
    read();
    if (!o_.references.empty()) reference_ = read_reference(o_, index_);
    prepare();
    build();
    double seconds = o_.seconds;
    if (o_.references.empty()) {
      if (!make_own_reference(seconds * kReferenceShare)) return std::move(chart_);
      seconds *= 1 - kReferenceShare;
    }
    const NoisyReference reference(reference_.mean,
                                   reference_.variance ? &*reference_.variance : nullptr);
    chart_.reference_source = reference_.source;
    chart_.reference_caveat = reference_.caveat;
    chart_.reference_noise = reference.noise();
    chart_.reference = reference_.mean;
    make_renderers(reference, seconds);
    take_turns();
    for (const auto& r : renderers_) chart_.lines.push_back(std::move(r->line));
    for (ChartLine& line : chart_.lines) finish(line);
    return std::move(chart_);
  }

 private:
  void read() {
    description_ = load_scene(chart_.file, o_.read).description;
    if (o_.sensor >= description_.sensors.size())
      throw UsageError(fmt::format("-s {}: there {} sensor{}", o_.sensor,
                                   description_.sensors.size() == 1
                                       ? "is 1"
                                       : fmt::format("are {}", description_.sensors.size()),
                                   description_.sensors.size() == 1 ? "" : "s"));
  }

  /// The image has the reference's size unless that would be another picture.
  void choose_size() {
    FilmDescription& film = description_.sensors[o_.sensor].film;
    render_.layout = film_layout(film, o_.size, std::nullopt);
    chart_.width = render_.layout.crop.width(), chart_.height = render_.layout.crop.height();
    if (o_.references.empty()) return;
    const int w = reference_.mean.width, h = reference_.mean.height;
    if (w == chart_.width && h == chart_.height) return;
    const bool same_shape = std::abs(double(w) * chart_.height - double(h) * chart_.width) <
                            0.5 * std::max(chart_.width, chart_.height);
    if (o_.size || film.crop || !same_shape)
      throw SceneFailure(fmt::format("the image is {}x{}, the reference {}x{}", chart_.width,
                                     chart_.height, w, h));
    log::info("{}: rendered at {}x{}, the size of the reference", chart_.name, w, h);
    render_.layout = film_layout(film, Point2i{w, h}, std::nullopt);
    chart_.width = w, chart_.height = h;
  }

  /// Everything that can be wrong with the command line for this scene shows here.
  void prepare() {
    choose_size();
    if (chart_.width < NoisyReference::kTiles || chart_.height < NoisyReference::kTiles)
      throw SceneFailure(
          fmt::format("an image of {}x{} is too small for a chart", chart_.width, chart_.height));
    for (const ChartMethod& m : o_.methods) integrators_.push_back(make(m));
    if (o_.references.empty()) choose_reference_method();
  }

  struct Prepared {
    std::string name, parameters;
    std::unique_ptr<Integrator> integrator;
  };

  Prepared make(const ChartMethod& m) const {
    IntegratorDescription d = description_.integrator;
    d.aovs.layers.clear();
    d.moments = false;
    try {
      // Distances and layers are no light that a reference could have.
      if (m.integrator.name == "depth" || m.integrator.name == "ao" || m.integrator.name == "aov")
        throw std::invalid_argument(fmt::format("\"{}\" makes no colours to compare", m.name));
      apply_override(d, m.integrator);
      Diagnostics diagnostics;
      check_support(description_, d, diagnostics);
      check_support(description_.sensors.at(o_.sensor), d, diagnostics);
      report(diagnostics, o_.read.strict);
      Prepared p{m.name, integrator_parameters(d), make_integrator(d)};
      return p;
    } catch (const std::invalid_argument& e) {
      throw UsageError(e.what());
    }
  }

  void choose_reference_method() {
    const ChartMethod* chosen = nullptr;
    ChartMethod named;
    if (!o_.reference_integrator.empty()) {
      const std::vector<ChartMethod> methods = parse_methods(o_.reference_integrator);
      if (methods.size() != 1) throw UsageError("--reference-integrator: one method is needed");
      named = methods[0];
      chosen = &named;
    }
    for (const ChartMethod& m : o_.methods)
      if (!chosen && m.integrator.name == "bdpt") chosen = &m;
    for (size_t i = 0; i < o_.methods.size() && !chosen; ++i)
      if (!is_biased(o_.methods[i].integrator.name, *integrators_[i].integrator))
        chosen = &o_.methods[i];
    if (!chosen)
      throw UsageError(
          "without --reference one has to be made, and no method here is without bias: choose one "
          "with --reference-integrator");
    reference_method_ = make(*chosen);
  }

  static bool is_biased(const std::string& name, const Integrator& integrator) {
    return name == "direct" || integrator.blurs() || !integrator.bias().empty();
  }

  void build() {
    BuildOptions build;
    build.sensor = o_.sensor;
    build.threads = o_.threads;
    Diagnostics diagnostics;
    scene_ = build_scene(std::move(description_), build, diagnostics);
    report(diagnostics, o_.read.strict);
    render_.scene = scene_.get();
    render_.seed = o_.seed;
    render_.threads = o_.threads;
    render_.cancel = &interrupt_flag();
  }

  bool make_own_reference(double seconds) {
    log::info("{}: there is no --reference; one is made with {} in {:.3g} s", chart_.name,
              reference_method_.name, seconds);
    auto made =
        make_reference(render_, *reference_method_.integrator, reference_method_.name, seconds);
    if (!made) {
      log::warning("{}: interrupted before there was a reference; there is no chart", chart_.name);
      return false;
    }
    reference_ = std::move(*made);
    save_reference(reference_, directory_);
    return true;
  }

  void make_renderers(const NoisyReference& reference, double seconds) {
    const double share = seconds / double(integrators_.size() + o_.external.size());
    for (Prepared& p : integrators_) {
      renderers_.push_back(
          std::make_unique<OwnRenderer>(render_, std::move(p.integrator), reference, share));
      renderers_.back()->line.name = p.name;
      renderers_.back()->line.parameters = p.parameters;
    }
    for (const auto& [name, command] : o_.external) {
      const std::string output =
          (std::filesystem::path(directory_) / "external-output.exr").string();
      renderers_.push_back(std::make_unique<ExternalRenderer>(
          ExternalRenderer::Task{command, chart_.file, output, o_.seed, &interrupt_flag()},
          reference, share));
      renderers_.back()->line.name = name;
      renderers_.back()->line.parameters = command;
    }
    share_ = share;
  }

  /// Whoever has used the least time is next.
  void take_turns() {
    while (!interrupt_flag().load()) {
      ChartRenderer* next = nullptr;
      for (const auto& r : renderers_)
        if (!r->finished() && (!next || r->used() < next->used())) next = r.get();
      if (!next) break;
      next->slice(share_ * kSliceShare);
      show_progress();
    }
    for (const auto& r : renderers_) r->finish();
  }

  void show_progress() {
    double used = 0;
    for (const auto& r : renderers_) used += r->used();
    if (used - shown_ < kSecondsBetweenLines) return;
    shown_ = used;
    std::string text;
    for (const auto& r : renderers_)
      if (!r->line.points.empty())
        text += fmt::format(", {} {}", r->line.name,
                            percent(std::sqrt(std::max(0.0, r->line.points.back().trimmed))));
    log::info("{}: {:.0f} %{}", chart_.name, 100 * used / (share_ * double(renderers_.size())),
              text);
  }

  void finish(ChartLine& line) {
    fit(line);
    if (!line.failure.empty()) {
      log::warning("{}: {} ended early, {}", chart_.name, line.name, line.failure);
      chart_.notes.push_back(fmt::format("{} ended early, {}.", line.name, line.failure));
    }
    if (!line.bias.empty()) chart_.notes.push_back(fmt::format("{}: {}.", line.name, line.bias));
    if (!line.points.empty() && line.points.back().trimmed < 0.5 * chart_.reference_noise)
      chart_.notes.push_back(
          fmt::format("The last points of {} are closer to the truth than the reference is; what "
                      "was subtracted "
                      "for its noise decides them.",
                      line.name));
  }

  const ChartOptions& o_;
  const size_t index_;
  const std::string directory_;
  ChartScene chart_;
  SceneDescription description_;
  ChartReference reference_;
  ChartRender render_;
  std::vector<Prepared> integrators_;
  Prepared reference_method_;
  std::unique_ptr<Scene> scene_;
  std::vector<std::unique_ptr<ChartRenderer>> renderers_;
  double share_ = 0, shown_ = 0;
};

}  // namespace

ChartScene measure_scene(const ChartOptions& options, size_t index, const std::string& name,
                         const std::string& directory) {
  return SceneChart(options, index, name, directory).run();
}

}  // namespace duet
