#include "evaluate/chart/measure.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>

#include "base/percent.h"
#include "scene/build.h"
#include "scene/film_layout.h"

namespace duet {

namespace {

/// Nobody has more than this share of his time at once, so that all see the same machine.
constexpr double kSliceShare = 1.0 / 32;
/// The share of a scene's time in which a reference is made if there is none.
constexpr double kReferenceShare = 0.5;
constexpr double kSecondsBetweenLines = 5;

class SceneChart {
 public:
  SceneChart(ChartPlan plan, const ChartMessages& messages)
      : plan_(std::move(plan)), messages_(messages) {
    chart_.name = plan_.name;
    chart_.file = plan_.file;
    chart_.threads = plan_.threads;
    chart_.seconds = plan_.seconds;
  }

  ChartScene run() {
    const bool has_reference = plan_.reference.has_value();
    prepare();
    build();
    double seconds = plan_.seconds;
    if (!has_reference) {
      if (!make_own_reference(seconds * kReferenceShare)) return std::move(chart_);
      seconds *= 1 - kReferenceShare;
    }
    const ChartReference& r = *plan_.reference;
    const NoisyReference reference(r.mean, r.variance ? &*r.variance : nullptr);
    chart_.reference_source = r.source;
    chart_.reference_caveat = r.caveat;
    chart_.reference_noise = reference.noise();
    chart_.reference = r.mean;
    make_renderers(reference, seconds);
    take_turns();
    for (const auto& renderer : renderers_) chart_.lines.push_back(std::move(renderer->line));
    for (ChartLine& line : chart_.lines) finish(line);
    return std::move(chart_);
  }

 private:
  /// The image has the reference's size unless that would be another picture.
  void choose_size() {
    FilmDescription& film = plan_.description.sensors[plan_.sensor].film;
    render_.layout = film_layout(film, plan_.size);
    chart_.width = render_.layout.crop.width(), chart_.height = render_.layout.crop.height();
    if (!plan_.reference) return;
    const int w = plan_.reference->mean.width, h = plan_.reference->mean.height;
    if (w == chart_.width && h == chart_.height) return;
    const bool same_shape = std::abs(double(w) * chart_.height - double(h) * chart_.width) <
                            0.5 * std::max(chart_.width, chart_.height);
    if (plan_.size || film.crop || !same_shape)
      throw std::runtime_error(fmt::format("the image is {}x{}, the reference {}x{}", chart_.width,
                                           chart_.height, w, h));
    info("rendered at {}x{}, the size of the reference", w, h);
    render_.layout = film_layout(film, Point2i{w, h});
    chart_.width = w, chart_.height = h;
  }

  /// Everything that can be wrong with the plan for this scene shows here.
  void prepare() {
    choose_size();
    if (chart_.width < NoisyReference::kTiles || chart_.height < NoisyReference::kTiles)
      throw std::runtime_error(
          fmt::format("an image of {}x{} is too small for a chart", chart_.width, chart_.height));
    for (const ChartMethod& m : plan_.methods) integrators_.push_back(make(m));
    if (!plan_.reference) choose_reference_method();
  }

  struct Prepared {
    std::string name, parameters;
    std::unique_ptr<Integrator> integrator;
    IntegratorDescription description;
    /// By what it chooses lights if the chart says so: that is built into scenes.
    std::string light_selection;
  };

  Prepared make(const ChartMethod& m) const {
    IntegratorDescription d = plan_.description.integrator;
    d.aovs.layers.clear();
    d.moments = false;
    try {
      // Distances and layers are no light that a reference could have.
      if (m.integrator.name == "depth" || m.integrator.name == "ao" || m.integrator.name == "aov")
        throw std::invalid_argument(fmt::format("\"{}\" makes no colours to compare", m.name));
      apply_override(d, m.integrator);
      Diagnostics diagnostics;
      check_support(plan_.description, d, diagnostics);
      check_support(plan_.description.sensors.at(plan_.sensor), d, diagnostics);
      messages_.report(diagnostics);
      Prepared p{m.name, integrator_parameters(d), make_integrator(d), d, ""};
      for (const auto& [name, value] : m.integrator.parameters)
        if (name == "light_selection") p.light_selection = value;
      return p;
    } catch (const std::invalid_argument& e) {
      throw ChartMethodError(e.what());
    }
  }

  void choose_reference_method() {
    const std::vector<ChartMethod>& methods = plan_.methods;
    const ChartMethod* chosen = plan_.reference_method ? &*plan_.reference_method : nullptr;
    for (const ChartMethod& m : methods)
      if (!chosen && m.integrator.name == "bdpt") chosen = &m;
    for (size_t i = 0; i < methods.size() && !chosen; ++i)
      if (!is_biased(methods[i].integrator.name, *integrators_[i].integrator)) chosen = &methods[i];
    if (!chosen)
      throw ChartMethodError(
          "without --reference one has to be made, and no method here is without bias: choose one "
          "with --reference-integrator");
    reference_method_ = make(*chosen);
  }

  static bool is_biased(const std::string& name, const Integrator& integrator) {
    return name == "direct" || integrator.blurs() || !integrator.bias().empty();
  }

  void build() {
    render_.seed = plan_.seed;
    render_.threads = plan_.threads;
    render_.cancel = plan_.cancel;
    std::map<std::string, const IntegratorDescription*> selections;
    for (const Prepared& p : integrators_) selections[p.light_selection] = &p.description;
    if (reference_method_.integrator)
      selections[reference_method_.light_selection] = &reference_method_.description;
    for (const auto& [selection, integrator] : selections) {
      SceneDescription description = plan_.description;
      if (!selection.empty()) description.integrator = *integrator;
      if (selection == selections.rbegin()->first) plan_.description = {};
      build(selection, std::move(description));
    }
  }

  void build(const std::string& selection, SceneDescription description) {
    BuildOptions build;
    build.sensor = plan_.sensor;
    build.threads = plan_.threads;
    Diagnostics diagnostics;
    scenes_.push_back(build_scene(std::move(description), build, diagnostics));
    messages_.report(diagnostics);
    ChartRender& render = renders_[selection] = render_;
    render.scene = scenes_.back().get();
  }

  bool make_own_reference(double seconds) {
    info("there is no --reference; one is made with {} in {:.3g} s", reference_method_.name,
         seconds);
    auto made = make_reference(renders_.at(reference_method_.light_selection),
                               *reference_method_.integrator, reference_method_.name, seconds);
    if (!made) {
      warning("interrupted before there was a reference; there is no chart");
      return false;
    }
    plan_.reference = std::move(*made);
    if (!plan_.directory.empty())
      save_reference(*plan_.reference, plan_.directory, plan_.command_line);
    return true;
  }

  void make_renderers(const NoisyReference& reference, double seconds) {
    const double share = seconds / double(integrators_.size() + plan_.external.size());
    for (Prepared& p : integrators_) {
      renderers_.push_back(std::make_unique<OwnRenderer>(
          renders_.at(p.light_selection), std::move(p.integrator), reference, share));
      renderers_.back()->line.name = p.name;
      renderers_.back()->line.parameters = p.parameters;
    }
    ExternalRun run;
    run.scene = chart_.file;
    run.output = (std::filesystem::path(plan_.directory) / "external-output.exr").string();
    run.seed = plan_.seed;
    run.width = reference.width(), run.height = reference.height();
    for (const ExternalMethod& e : plan_.external) {
      renderers_.push_back(std::make_unique<ExternalRenderer>(
          ExternalRenderer::Task{e.command, run, plan_.cancel}, reference, share));
      renderers_.back()->line.name = e.name;
      renderers_.back()->line.parameters = e.text;
    }
    share_ = share;
  }

  /// Whoever has used the least time is next.
  void take_turns() {
    while (!plan_.cancel->load()) {
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
    info("{:.0f} %{}", 100 * used / (share_ * double(renderers_.size())), text);
  }

  void finish(ChartLine& line) {
    fit(line);
    if (!line.failure.empty()) {
      warning("{} ended early, {}", line.name, line.failure);
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

  template <class... Args>
  void info(fmt::format_string<Args...> text, Args&&... args) const {
    messages_.info(chart_.name + ": " + fmt::format(text, std::forward<Args>(args)...));
  }
  template <class... Args>
  void warning(fmt::format_string<Args...> text, Args&&... args) const {
    messages_.warning(chart_.name + ": " + fmt::format(text, std::forward<Args>(args)...));
  }

  ChartPlan plan_;
  const ChartMessages& messages_;
  ChartScene chart_;
  ChartRender render_;                          ///< without a scene
  std::map<std::string, ChartRender> renders_;  ///< by Prepared::light_selection
  std::vector<Prepared> integrators_;
  Prepared reference_method_;
  std::vector<std::unique_ptr<Scene>> scenes_;
  std::vector<std::unique_ptr<ChartRenderer>> renderers_;
  double share_ = 0, shown_ = 0;
};

}  // namespace

ChartScene measure_chart(ChartPlan plan, const ChartMessages& messages) {
  return SceneChart(std::move(plan), messages).run();
}

}  // namespace duet
