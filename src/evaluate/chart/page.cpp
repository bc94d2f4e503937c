#include "evaluate/chart/page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "base/percent.h"
#include "base/seconds_text.h"
#include "base/system/atomic_file.h"
#include "evaluate/chart/colours.h"
#include "evaluate/chart/svg.h"
#include "evaluate/web/page.h"

namespace duet {

namespace {

/// Longest side of an image on the page.
constexpr int kLongest = 1024;

std::string significant(double v) {
  return std::isfinite(v) ? fmt::format("{:.3g}", v) : "∞";
}

std::string error_text(const ChartPoint& p) {
  return p.trimmed > 0 ? percent(std::sqrt(p.trimmed)) : "below the reference's noise";
}

std::string swatch(size_t index, const std::string& name) {
  std::string text;
  for (const char c : name) {  // parameters may stand on lines of their own
    text += escape_markup(std::string(1, c));
    if (c == ',' || c == ':') text += "<wbr>";
  }
  return fmt::format("<span class=\"swatch {}\"></span>{}", series_class(index), text);
}

std::string slope_cell(const ChartLine& line) {
  if (!line.by_time.slope) return "<td class=\"none\">–</td>";
  const SlopeFit& s = *line.by_time.slope;
  return fmt::format(
      "<td data-value=\"{0:.9g}\">{0:.3f}<br><span class=\"interval\">[{1:.3f}, "
      "{2:.3f}]</span></td>",
      s.slope, s.slope_95.low, s.slope_95.high);
}

std::string time_cell(const ChartLine& line, double error, const std::string& mark) {
  const auto t = time_to_error(line, error);
  if (!t) return "<td class=\"none\">–</td>";
  std::string text = significant(t->cpu_seconds);
  if (t->kind == TimeToError::extrapolated)
    text = fmt::format("<span class=\"soft\">≈ {}</span>", text);
  if (t->kind == TimeToError::at_most) text = "≤ " + text;
  return fmt::format("<td{} data-value=\"{:.9g}\" title=\"{} to {}\">{}</td>", mark, t->cpu_seconds,
                     significant(t->interval_95.low), significant(t->interval_95.high), text);
}

std::string efficiency_cells(const ChartLine& line, double best, const std::string& mark) {
  const auto e = efficiency(line);
  if (!e) return "<td class=\"none\">–</td><td class=\"none\">–</td>";
  return fmt::format(
      "<td{0} data-value=\"{1:.9g}\">{2}<br><span class=\"interval\">[{3}, {4}]</span></td>"
      "<td{0} data-value=\"{5:.9g}\">{5:.2f}</td>",
      mark, e->value, significant(e->value), significant(e->interval_95.low),
      significant(e->interval_95.high), e->value / best);
}

std::string row(const ChartScene& scene, size_t index, const std::vector<double>& errors) {
  const ChartLine& line = scene.lines[index];
  std::string html = fmt::format("<tr><td class=\"name\">{}</td>", swatch(index, line.name));
  if (line.points.empty())
    return html + fmt::format("<td colspan=\"{}\" class=\"text\">{}</td></tr>\n", 8 + errors.size(),
                              escape_markup(line.failure.empty() ? "no image" : line.failure));
  const ChartPoint& p = line.points.back();
  const size_t lines = scene.lines.size();
  const auto number = [](double value, const std::string& text) {
    return fmt::format("<td data-value=\"{:.9g}\">{}</td>", value, text);
  };
  html += number(p.spp, fmt::to_string(p.spp)) + number(p.cpu_seconds, significant(p.cpu_seconds)) +
          number(p.trimmed, error_text(p)) + number(p.relmse, significant(p.relmse)) +
          number(p.firefly, fmt::format("{:.2f} %", 100 * p.firefly)) + slope_cell(line);
  html += efficiency_cells(line, best_efficiency(scene),
                           best_mark(most_efficient(scene), index, lines));
  for (const double e : errors)
    html += time_cell(line, e, best_mark(fastest(scene, e), index, lines));
  return html + "</tr>\n";
}

std::string table(const ChartScene& scene) {
  const std::vector<double> errors = round_errors(scene);
  std::string html =
      "<div class=\"card scroll\"><table "
      "class=\"sortable\">\n<thead><tr><th>method</th><th>spp</th>"
      "<th>CPU s</th><th>√trimmed</th><th>relMSE</th><th>fireflies</th>"
      "<th>slope</th><th>efficiency</th><th>to best</th>";
  for (const double e : errors) html += fmt::format("<th>s to {:g} %</th>", 100 * e);
  html += "</tr></thead>\n<tbody>\n";
  for (size_t i = 0; i < scene.lines.size(); ++i) html += row(scene, i, errors);
  return html + "</tbody></table></div>\n";
}

std::string explanations() {
  return "<p class=\"soft\"><em>trimmed</em> is the mean of (a − b)² / (b² + 0.01) without the "
         "worst "
         "0.1 % of the pixels, <em>√trimmed</em> its root, as in the charts; <em>relMSE</em> is "
         "the "
         "same with them. From both the variance of the reference is subtracted, where it is "
         "known. "
         "<em>Fireflies</em>: the share of the image's light that is in its brightest 0.1 % of "
         "pixels. <em>Efficiency</em>: 1 / (trimmed · CPU seconds). Seconds to a √trimmed are CPU "
         "seconds, ≈ by the fitted slope beyond the last point, ≤ where the first point is better "
         "already. Intervals are of 95 %, from a bootstrap over 8×8 tiles of the image. "
         "<span class=\"best\">Bold</span> is the best of a column if no other interval overlaps "
         "its own; otherwise those that may be the best are <span "
         "class=\"tied\">underlined</span>. "
         "The methods took turns in short slices, so that all saw the same machine; the scene was "
         "read and built once, which is not counted, while an external renderer is timed as a "
         "whole "
         "process.</p>\n";
}

/// FLIP over the exposures, or of the range of a display if the reference is black.
FlipResult flip_of(const Image& image, const ChartScene& scene) {
  if (auto flip = hdr_flip(image, scene.reference, scene.threads)) return std::move(*flip);
  return ldr_flip(image, scene.reference);
}

std::string viewer(const ChartScene& scene) {
  std::vector<ViewedImage> images;
  for (const ChartLine& line : scene.lines) {
    if (line.points.empty()) continue;
    const ChartPoint& p = line.points.back();
    images.push_back({line.name,
                      fmt::format("{}: {} spp, {:.3g} CPU s, √trimmed {}", line.name, p.spp,
                                  p.cpu_seconds, error_text(p)),
                      web_image(line.image, kLongest),
                      web_flip(flip_of(line.image, scene), line.image.width, kLongest)});
  }
  images.push_back({"reference",
                    "reference: " + scene.reference_source,
                    web_image(scene.reference, kLongest),
                    {}});
  std::string html = "<h2>The images after equal time</h2>\n";
  if (images[0].image.reduced_by > 1)
    html += fmt::format(
        "<p class=\"soft\">Reduced to 1/{} of the size for this page; all numbers are "
        "of the whole images.</p>\n",
        images[0].image.reduced_by);
  return html + "<div class=\"card\">" + viewer_html(images, images.size() - 1) + "</div>\n" +
         viewer_keys();
}

std::string methods_list(const ChartScene& scene, const std::string& command_line) {
  std::string html =
      "<h2>How this was made</h2>\n<div class=\"card scroll\"><table>\n<tr><th>method</th>"
      "<th class=\"text\">parameters</th></tr>\n";
  for (size_t i = 0; i < scene.lines.size(); ++i)
    html += fmt::format("<tr><td>{}</td><td class=\"text\"><code>{}</code></td></tr>\n",
                        swatch(i, scene.lines[i].name), escape_markup(scene.lines[i].parameters));
  return html + "</table></div>\n" +
         fmt::format("<pre>{}</pre>\n<p class=\"soft\">Scene {}, with Duet " DUET_VERSION ".</p>\n",
                     escape_markup(command_line), escape_markup(scene.file));
}

std::string embedded(const std::string& svg) {
  return "<figure>" + svg + "</figure>\n";
}

}  // namespace

std::string best_mark(const std::vector<size_t>& contenders, size_t index, size_t lines) {
  if (lines < 2 || std::find(contenders.begin(), contenders.end(), index) == contenders.end())
    return "";
  return contenders.size() == 1 ? " class=\"best\"" : " class=\"tied\"";
}

std::string chart_page(const ChartScene& scene, const std::string& command_line) {
  std::string body = fmt::format(
      "<h1>{}: accuracy against time</h1>\n<p class=\"soft\">{} method{}, {}×{} pixels, {} "
      "thread{}, "
      "{} together. Reference: {}{}.</p>\n",
      escape_markup(scene.name), scene.lines.size(), scene.lines.size() == 1 ? "" : "s",
      scene.width, scene.height, scene.threads, scene.threads == 1 ? "" : "s",
      seconds_text(scene.seconds), escape_markup(scene.reference_source),
      scene.reference_caveat.empty() ? "" : "; " + escape_markup(scene.reference_caveat));
  body += "<div class=\"charts\">\n" + embedded(chart_svg(scene, ChartAxis::cpu_seconds)) +
          embedded(chart_svg(scene, ChartAxis::spp)) + "</div>\n";
  body += "<h2>In numbers</h2>\n" + table(scene) + explanations();
  if (!scene.notes.empty()) {
    body += "<ul>\n";
    for (const std::string& note : scene.notes)
      body += fmt::format("<li>{}</li>\n", escape_markup(note));
    body += "</ul>\n";
  }
  body += viewer(scene) + methods_list(scene, command_line);
  return web_page(scene.name + ": accuracy against time", body);
}

void write_chart(const ChartScene& scene, const std::string& folder,
                 const std::string& command_line) {
  const std::filesystem::path in = folder;
  write_file_atomically((in / "chart.csv").string(), chart_csv(scene));
  write_file_atomically((in / "chart.svg").string(), chart_svg(scene, ChartAxis::cpu_seconds));
  write_file_atomically((in / "chart-spp.svg").string(), chart_svg(scene, ChartAxis::spp));
  write_file_atomically((in / "index.html").string(), chart_page(scene, command_line));
}

std::string write_chart_index(const std::vector<ChartScene>& scenes, const std::string& folder,
                              const std::string& command_line) {
  const std::filesystem::path in = folder;
  write_file_atomically((in / "summary.csv").string(), summary_csv(scenes));
  const std::string page = (in / "index.html").string();
  write_file_atomically(page, chart_index(scenes, command_line));
  return page;
}

}  // namespace duet
