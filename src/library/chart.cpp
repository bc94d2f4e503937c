#include "duet/chart.h"

#include <cmath>
#include <stdexcept>

#include "base/parallel.h"
#include "evaluate/chart/measure.h"
#include "evaluate/chart/page.h"
#include "evaluate/chart/svg.h"
#include "library/contents.h"

namespace duet {

struct MethodChart::Contents {
  ChartScene scene;
  std::vector<ChartedLine> lines;
};

namespace {

ChartReference reference_of(const ChartSettings& s) {
  try {
    return read_reference(s.reference, s.reference_variance, s.reference_spp);
  } catch (const ReadError& e) {
    throw FileError(e.what());
  } catch (const UnknownSamples& e) {
    throw std::invalid_argument(e.what());
  }
}

void check(const SceneFile& scene, const ChartSettings& s) {
  const size_t sensors = scene.contents().loaded.description.sensors.size();
  if (s.sensor >= sensors)
    throw std::out_of_range(fmt::format("sensor {}: the scene has {}", s.sensor, sensors));
  if (s.methods.empty()) throw std::invalid_argument("there are no methods to compare");
  if (!(s.seconds > 0) || !std::isfinite(s.seconds))
    throw std::invalid_argument(fmt::format("{} seconds are no time for a chart", s.seconds));
  if (s.reference.empty() && !s.reference_variance.empty())
    throw std::invalid_argument("a variance is that of a reference");
}

ChartPlan plan_of(const SceneFile& scene, const ChartSettings& s) {
  ChartPlan plan;
  plan.name = plan.file = scene.name();
  plan.description = scene.contents().loaded.description;
  plan.sensor = s.sensor;
  if (s.size) plan.size = Point2i{(*s.size)[0], (*s.size)[1]};
  for (const ChartedMethod& m : s.methods)
    plan.methods.push_back(
        {m.name.empty() ? m.integrator : m.name, {m.integrator, m.parameters, {}}});
  if (!s.reference.empty()) plan.reference = reference_of(s);
  plan.seconds = s.seconds;
  plan.seed = s.seed;
  plan.threads = startable_threads(threads_or_all(s.threads));
  return plan;
}

ChartMessages messages_of(const ChartWatch& watch) {
  const auto tell = [](const std::function<void(const std::string&)>& whom) {
    return [&whom](const std::string& text) {
      if (whom) whom(text);
    };
  };
  return {tell(watch.info), tell(watch.warning), [&watch](const Diagnostics& diagnostics) {
            std::vector<SceneMessage> messages = scene_messages(diagnostics);
            if (diagnostics.has_errors()) throw SceneError(std::move(messages));
            for (const SceneMessage& m : messages)
              if (watch.warning) watch.warning(m.text);
          }};
}

ChartedLine line_of(const ChartLine& line) {
  ChartedLine made{line.name, line.parameters, line.bias, line.failure, {}, {}, {}};
  for (const ChartPoint& p : line.points)
    made.points.push_back({p.seconds, p.cpu_seconds, p.spp, p.mse, p.relmse, p.trimmed, p.firefly});
  if (const auto& s = line.by_time.slope)
    made.slope = ChartedEstimate{s->slope, s->slope_95.low, s->slope_95.high};
  if (const auto e = efficiency(line))
    made.efficiency = ChartedEstimate{e->value, e->interval_95.low, e->interval_95.high};
  return made;
}

}  // namespace

std::optional<MethodChart> chart_file(const SceneFile& scene, const ChartSettings& settings,
                                      const ChartWatch& watch) {
  check(scene, settings);
  ChartPlan plan = plan_of(scene, settings);
  const std::atomic<bool> never{false};
  plan.cancel = watch.cancel ? watch.cancel : &never;
  MethodChart::Contents made;
  try {
    made.scene = measure_chart(std::move(plan), messages_of(watch));
  } catch (const ChartMethodError& e) {
    throw std::invalid_argument(e.what());
  }
  if (made.scene.lines.empty()) return std::nullopt;
  for (const ChartLine& line : made.scene.lines) made.lines.push_back(line_of(line));
  return MethodChart(std::make_shared<const MethodChart::Contents>(std::move(made)));
}

const std::vector<ChartedLine>& MethodChart::lines() const {
  return contents_->lines;
}

const std::vector<std::string>& MethodChart::notes() const {
  return contents_->scene.notes;
}

int MethodChart::width() const {
  return contents_->scene.width;
}

int MethodChart::height() const {
  return contents_->scene.height;
}

const std::string& MethodChart::reference() const {
  return contents_->scene.reference_source;
}

std::string MethodChart::csv() const {
  return chart_csv(contents_->scene);
}

std::string MethodChart::svg() const {
  return chart_svg(contents_->scene, ChartAxis::cpu_seconds);
}

std::string MethodChart::svg_of_samples() const {
  return chart_svg(contents_->scene, ChartAxis::spp);
}

std::string MethodChart::page(const std::string& how_made) const {
  return chart_page(contents_->scene, how_made);
}

}  // namespace duet
