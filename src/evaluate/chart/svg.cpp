#include "evaluate/chart/svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "evaluate/chart/colours.h"
#include "evaluate/web/page.h"
#include "math/log_ticks.h"

namespace duet {

namespace {

constexpr double kLeft = 70, kTop = 58, kPlotWidth = 440, kPlotHeight = 330, kLegend = 226;
constexpr double kRight = kLeft + kPlotWidth, kBottom = kTop + kPlotHeight;
constexpr double kWidth = kRight + kLegend, kHeight = kBottom + 60;

/// From values to places along one direction.
struct LogAxis {
  double low, high;  ///< values
  double from, to;   ///< places
  double operator()(double value) const {
    const double t = std::log(value / low) / std::log(high / low);
    return from + t * (to - from);
  }
  bool contains(double v) const { return v >= low * 0.9999 && v <= high * 1.0001; }
  std::vector<Tick> ticks() const { return log_ticks(low, high); }
};

/// Room on both sides of values that are all above zero.
LogAxis axis_around(const std::vector<double>& values, double from, double to, double margin) {
  double low = INFINITY, high = 0;
  for (const double v : values) low = std::min(low, v), high = std::max(high, v);
  if (!(high > 0)) low = 0.5, high = 2;
  if (high < 4 * low) {  // at least this much, so that a single point has a chart
    const double middle = std::sqrt(low * high);
    low = middle / 2, high = middle * 2;
  }
  const double extra = std::pow(high / low, margin);
  return {low / extra, high * extra, from, to};
}

std::string percent_tick(double v) {
  return tick_text(100 * v) + " %";
}

double x_of(const ChartPoint& p, ChartAxis axis) {
  return axis == ChartAxis::spp ? double(p.spp) : p.cpu_seconds;
}

const CurveFit& fit_of(const ChartLine& line, ChartAxis axis) {
  return axis == ChartAxis::spp ? line.by_spp : line.by_time;
}

/// One of four shapes, in the colour of the group that it is in.
std::string marker(size_t index, double x, double y) {
  const auto polygon = [](const std::string& points) {
    return fmt::format("<polygon class=\"point\" points=\"{}\" fill=\"currentColor\"/>", points);
  };
  switch (index % 4) {
    case 1:
      return fmt::format(
          "<rect class=\"point\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"6.4\" height=\"6.4\" "
          "fill=\"currentColor\"/>",
          x - 3.2, y - 3.2);
    case 2:
      return polygon(fmt::format("{:.1f},{:.1f} {:.1f},{:.1f} {:.1f},{:.1f}", x, y - 4.4, x + 4,
                                 y + 3, x - 4, y + 3));
    case 3:
      return polygon(fmt::format("{:.1f},{:.1f} {:.1f},{:.1f} {:.1f},{:.1f} {:.1f},{:.1f}", x,
                                 y - 4.4, x + 4.4, y, x, y + 4.4, x - 4.4, y));
    default:
      return fmt::format(
          "<circle class=\"point\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3.6\" "
          "fill=\"currentColor\"/>",
          x, y);
  }
}

/// Draws one chart.
class Drawing {
 public:
  Drawing(const ChartScene& scene, ChartAxis axis) : scene_(scene), axis_(axis) {
    std::vector<double> xs, ys;
    for (const ChartLine& line : scene.lines)
      for (const ChartPoint& p : line.points)
        if (p.trimmed > 0 && x_of(p, axis) > 0)
          xs.push_back(x_of(p, axis)), ys.push_back(std::sqrt(p.trimmed));
    x_ = axis_around(xs, kLeft, kRight, 0.03);
    y_ = axis_around(ys, kBottom, kTop, 0.06);
  }

  std::string run() {
    open();
    grid();
    guides();
    noise();
    for (size_t i = 0; i < scene_.lines.size(); ++i) line(i);
    legend();
    return svg_ + "</svg>\n";
  }

 private:
  template <class... Args>
  void add(fmt::format_string<Args...> text, Args&&... args) {
    svg_ += fmt::format(text, std::forward<Args>(args)...) + "\n";
  }

  void open() {
    const char* against = axis_ == ChartAxis::spp ? "samples per pixel" : "CPU seconds";
    const std::string title = fmt::format("{}: error against {}", scene_.name, against);
    add("<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {:.0f} {:.0f}\" role=\"img\" "
        "class=\"chart\" font-family=\"system-ui, 'Segoe UI', Helvetica, Arial, sans-serif\" "
        "font-size=\"13\" fill=\"{}\">",
        kWidth, kHeight, kInk.light);
    add("<style>\n{}</style>", chart_style());
    add("<title>{}</title>", escape_markup(title));
    add("<desc>Root of the relMSE without the worst 0.1 % of the pixels, on logarithmic "
        "axes</desc>");
    add("<clipPath id=\"{}\"><rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"/></clipPath>",
        clip_, kLeft, kTop, kPlotWidth, kPlotHeight);
    add("<rect class=\"paper\" width=\"100%\" height=\"100%\" rx=\"8\" fill=\"{}\"/>",
        kPaper.light);
    add("<text x=\"{}\" y=\"26\" font-size=\"17\" font-weight=\"600\">{}</text>", kLeft,
        escape_markup(scene_.name));
    add("<text class=\"soft\" x=\"{}\" y=\"45\" fill=\"{}\">√trimmed (root of the trimmed relMSE) "
        "against {}, {}×{}, {} thread{}</text>",
        kLeft, kSoft.light, against, scene_.width, scene_.height, scene_.threads,
        scene_.threads == 1 ? "" : "s");
    add("<text x=\"{}\" y=\"{}\" text-anchor=\"middle\">{}</text>", kLeft + kPlotWidth / 2,
        kBottom + 44, against);
  }

  void grid() {
    add("<g class=\"grid\" stroke=\"{}\">", kGrid.light);
    for (const Tick& t : x_.ticks())
      add("<line x1=\"{0:.1f}\" x2=\"{0:.1f}\" y1=\"{1}\" y2=\"{2}\"/>", x_(t.value), kTop,
          kBottom);
    for (const Tick& t : y_.ticks())
      add("<line x1=\"{1}\" x2=\"{2}\" y1=\"{0:.1f}\" y2=\"{0:.1f}\"/>", y_(t.value), kLeft,
          kRight);
    add("</g>\n<rect class=\"frame\" x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"none\" "
        "stroke=\"{}\"/>\n<g class=\"ticks\">",
        kLeft, kTop, kPlotWidth, kPlotHeight, kFrame.light);
    for (const Tick& t : x_.ticks())
      if (t.labelled)
        add("<text x=\"{:.1f}\" y=\"{}\" text-anchor=\"middle\">{}</text>", x_(t.value),
            kBottom + 20, tick_text(t.value));
    for (const Tick& t : y_.ticks())
      if (t.labelled)
        add("<text x=\"{}\" y=\"{:.1f}\" text-anchor=\"end\">{}</text>", kLeft - 8,
            y_(t.value) + 4.5, percent_tick(t.value));
    add("</g>");
  }

  /// Lines of known slopes through the upper left of the plot.
  void guides() {
    const double x0 = x_.low, x1 = x_.high;
    const double y0 = std::pow(y_.high, 0.97) * std::pow(y_.low, 0.03);
    add("<g class=\"guides\" clip-path=\"url(#{1})\" stroke=\"{0}\" fill=\"{0}\" "
        "stroke-dasharray=\"5 5\" font-size=\"12\">",
        kGuide.light, clip_);
    for (const auto& [name, slope] : {std::pair("−1/2", -0.5), std::pair("−1/3", -1.0 / 3)}) {
      const double y1 = y0 * std::pow(x1 / x0, slope);
      add("<line class=\"guide\" data-slope=\"{:.4f}\" x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" "
          "y2=\"{:.1f}\"/>",
          slope, x_(x0), y_(y0), x_(x1), y_(y1));
      // Its name stands near the end that is in view.
      double xe = x0 * std::pow(x1 / x0, 0.985), ye = y0 * std::pow(xe / x0, slope);
      if (ye < y_.low)
        ye = y_.low * std::pow(y_.high / y_.low, 0.06), xe = x0 * std::pow(ye / y0, 1 / slope);
      add("<text stroke=\"none\" text-anchor=\"end\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text>",
          x_(xe) + 4, y_(ye) - 6, name);
    }
    add("</g>");
  }

  /// The reference's own noise, which has been subtracted.
  void noise() {
    const double level = std::sqrt(scene_.reference_noise);
    if (!(level > 0) || !y_.contains(level)) return;
    add("<g class=\"noise\" stroke=\"{0}\" fill=\"{0}\"><line x1=\"{1}\" x2=\"{2}\" y1=\"{3:.1f}\" "
        "y2=\"{3:.1f}\" stroke-dasharray=\"2 4\"/><text x=\"{4}\" y=\"{5:.1f}\" font-size=\"11\" "
        "stroke=\"none\">noise of the reference, subtracted</text></g>",
        kNoise.light, kLeft, kRight, y_(level), kLeft + 6, y_(level) - 5);
  }

  void line(size_t index) {
    const ChartLine& l = scene_.lines[index];
    add("<g class=\"line {}\" data-name=\"{}\" clip-path=\"url(#{})\">", series_class(index),
        escape_markup(l.name), clip_);
    std::string upper, lower, path;
    const CurveFit& fit = fit_of(l, axis_);
    for (size_t i = 0; i < l.points.size(); ++i) {
      const ChartPoint& p = l.points[i];
      if (!(p.trimmed > 0)) continue;
      const double x = x_(x_of(p, axis_));
      path += fmt::format("{:.1f},{:.1f} ", x, y_(std::sqrt(p.trimmed)));
      const double low = std::sqrt(std::max(fit.value_95[i].low, 1e-4 * p.trimmed));
      upper += fmt::format("{:.1f},{:.1f} ", x, y_(std::sqrt(fit.value_95[i].high)));
      lower = fmt::format("{:.1f},{:.1f} ", x, y_(low)) + lower;
    }
    if (!path.empty()) {
      add("<polygon class=\"band\" points=\"{}{}\" fill=\"currentColor\" "
          "fill-opacity=\"0.13\"/>",
          upper, lower);
      add("<polyline points=\"{}\" fill=\"none\" stroke=\"currentColor\" stroke-width=\"2\"/>",
          path);
    }
    for (const ChartPoint& p : l.points) {
      if (!(p.trimmed > 0)) continue;
      svg_ += marker(index, x_(x_of(p, axis_)), y_(std::sqrt(p.trimmed)));
    }
    add("\n</g>");
  }

  void legend() {
    add("<g class=\"legend\">");
    double y = kTop + 10;
    const double x = kRight + 20;
    for (size_t i = 0; i < scene_.lines.size(); ++i) {
      const ChartLine& l = scene_.lines[i];
      add("<g class=\"entry\"><g class=\"{}\"><line x1=\"{}\" x2=\"{}\" y1=\"{}\" y2=\"{}\" "
          "stroke=\"currentColor\" stroke-width=\"2\"/>{}</g>",
          series_class(i), x - 6, x + 12, y, y, marker(i, x + 3, y));
      constexpr size_t longest = 22;
      const std::string name =
          l.name.size() > longest ? l.name.substr(0, longest - 1) + "…" : l.name;
      add("<text x=\"{}\" y=\"{}\" font-weight=\"600\">{}</text>", x + 20, y + 4.5,
          escape_markup(name));
      add("<text class=\"soft\" x=\"{}\" y=\"{}\" font-size=\"12\" fill=\"{}\">{}</text></g>",
          x + 20, y + 21, kSoft.light, slope_text(fit_of(l, axis_)));
      y += 46;
    }
    add("</g>");
  }

  static std::string slope_text(const CurveFit& fit) {
    if (!fit.slope) return "too few points for a slope";
    const auto number = [](double v) {
      return (v < 0 ? "−" : "") + fmt::format("{:.2f}", std::abs(v));
    };
    return fmt::format("slope {} [{}, {}]", number(fit.slope->slope),
                       number(fit.slope->slope_95.low), number(fit.slope->slope_95.high));
  }

  const ChartScene& scene_;
  const ChartAxis axis_;
  /// Pages hold several charts: a name of its own, as far as they differ.
  const char* const clip_ = axis_ == ChartAxis::spp ? "plot-spp" : "plot-time";
  LogAxis x_{}, y_{};
  std::string svg_;
};

}  // namespace

std::string chart_svg(const ChartScene& scene, ChartAxis axis) {
  return Drawing(scene, axis).run();
}

}  // namespace duet
