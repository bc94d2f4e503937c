#include "app/chart_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/chart_svg.h"
#include "app/commands.h"
#include "app/progress.h"
#include "app/web_page.h"
#include "base/percent.h"

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
  return fmt::format("<span class=\"swatch\" style=\"background:{}\"></span>{}",
                     chart_colour(index), escape_markup(name));
}

std::string slope_cell(const ChartLine& line) {
  if (!line.by_time.slope) return "–";
  const SlopeFit& s = *line.by_time.slope;
  return fmt::format("{:.3f} <span class=\"soft\">[{:.3f}, {:.3f}]</span>", s.slope, s.slope_95.low,
                     s.slope_95.high);
}

std::string time_cell(const ChartLine& line, double error) {
  const auto t = time_to_error(line, error);
  if (!t) return "–";
  if (t->kind == TimeToError::extrapolated)
    return fmt::format("<span class=\"soft\">≈ {}</span>", significant(t->cpu_seconds));
  return (t->kind == TimeToError::at_most ? "≤ " : "") + significant(t->cpu_seconds);
}

/// Whether this line needs the fewest CPU seconds to an error.
bool is_fastest(const ChartScene& scene, const ChartLine& line, double error) {
  const auto own = time_to_error(line, error);
  return own && std::all_of(scene.lines.begin(), scene.lines.end(), [&](const ChartLine& other) {
           const auto t = time_to_error(other, error);
           return !t || own->cpu_seconds <= t->cpu_seconds;
         });
}

std::string table(const ChartScene& scene) {
  const std::vector<double> errors = round_errors(scene);
  std::string html =
      "<div class=\"card scroll\"><table>\n<tr><th>method</th><th>spp</th><th>CPU s</th>"
      "<th>rel. RMSE</th><th>relMSE</th><th>trimmed</th><th>fireflies</th><th>slope</th>"
      "<th>efficiency</th><th>to best</th>";
  for (const double e : errors) html += fmt::format("<th>s to {:g} %</th>", 100 * e);
  html += "</tr>\n";
  const double best = best_efficiency(scene);
  for (size_t i = 0; i < scene.lines.size(); ++i) {
    const ChartLine& line = scene.lines[i];
    html += fmt::format("<tr><td>{}</td>", swatch(i, line.name));
    if (line.points.empty()) {
      html += fmt::format("<td colspan=\"{}\" class=\"text\">{}</td></tr>\n", 9 + errors.size(),
                          escape_markup(line.failure.empty() ? "no image" : line.failure));
      continue;
    }
    const ChartPoint& p = line.points.back();
    html += fmt::format(
        "<td>{}</td><td>{:.3g}</td><td>{}</td><td>{:.3g}</td><td>{:.3g}</td><td>{:.2f} %</td>"
        "<td>{}</td>",
        p.spp, p.cpu_seconds, error_text(p), p.relmse, p.trimmed, 100 * p.firefly,
        slope_cell(line));
    const auto e = efficiency(line);
    const char* mark = e && e->value == best ? " class=\"best\"" : "";
    html += e ? fmt::format("<td{}>{} <span class=\"soft\">[{}, {}]</span></td><td{}>{:.2f}</td>",
                            mark, significant(e->value), significant(e->interval_95.low),
                            significant(e->interval_95.high), mark, e->value / best)
              : "<td>–</td><td>–</td>";
    for (const double error : errors)
      html += fmt::format("<td{}>{}</td>", is_fastest(scene, line, error) ? " class=\"best\"" : "",
                          time_cell(line, error));
    html += "</tr>\n";
  }
  return html + "</table></div>\n";
}

std::string explanations() {
  return "<p class=\"soft\">Relative RMSE is the root of <em>trimmed</em>: the mean of "
         "(a − b)² / (b² + 0.01) without the worst 0.1 % of the pixels; <em>relMSE</em> is the "
         "same "
         "with them. From both the variance of the reference is subtracted, where it is known. "
         "<em>Fireflies</em>: the share of the image's light that is in its brightest 0.1 % of "
         "pixels. "
         "<em>Efficiency</em>: 1 / (trimmed · CPU seconds). Seconds to an error are CPU seconds, ≈ "
         "by "
         "the fitted slope beyond the last point, ≤ where the first point is better already. "
         "Intervals are of 95 %, from a bootstrap over 8×8 "
         "tiles of the image. The methods took turns in short slices, so that all saw the same "
         "machine; the scene was read and built once, which is not counted, while an external "
         "renderer is timed as a whole process.</p>\n";
}

std::string viewer(const ChartScene& scene) {
  std::vector<ViewedImage> images;
  for (const ChartLine& line : scene.lines) {
    if (line.points.empty()) continue;
    const ChartPoint& p = line.points.back();
    images.push_back({line.name,
                      fmt::format("{}: {} spp, {:.3g} CPU s, relative RMSE {}", line.name, p.spp,
                                  p.cpu_seconds, error_text(p)),
                      web_image(line.image, kLongest)});
  }
  images.push_back(
      {"reference", "reference: " + scene.reference_source, web_image(scene.reference, kLongest)});
  std::string html = "<h2>The images after equal time</h2>\n";
  if (images[0].image.reduced_by > 1)
    html += fmt::format(
        "<p class=\"soft\">Reduced to 1/{} of the size for this page; all numbers are "
        "of the whole images.</p>\n",
        images[0].image.reduced_by);
  return html + "<div class=\"card\">" + viewer_html(images, images.size() - 1) +
         "</div>\n<p class=\"soft\">Keys: <kbd>1</kbd>–<kbd>9</kbd> choose an image, "
         "<kbd>space</kbd> "
         "flips to the last one, <kbd>e</kbd> shows the error, <kbd>r</kbd> resets; drag to move; "
         "the "
         "wheel zooms once the viewer was clicked.</p>\n";
}

std::string methods_list(const ChartScene& scene) {
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

std::string chart_page(const ChartScene& scene) {
  std::string body = fmt::format(
      "<h1>{}: accuracy against time</h1>\n<p class=\"soft\">{} method{}, {}×{} pixels, {} "
      "thread{}, "
      "{} together. Reference: {}.</p>\n",
      escape_markup(scene.name), scene.lines.size(), scene.lines.size() == 1 ? "" : "s",
      scene.width, scene.height, scene.threads, scene.threads == 1 ? "" : "s",
      format_seconds(scene.seconds), escape_markup(scene.reference_source));
  body += "<div class=\"charts\">\n" + embedded(chart_svg(scene, ChartAxis::cpu_seconds)) +
          embedded(chart_svg(scene, ChartAxis::spp)) + "</div>\n";
  body += "<h2>In numbers</h2>\n" + table(scene) + explanations();
  if (!scene.notes.empty()) {
    body += "<ul>\n";
    for (const std::string& note : scene.notes)
      body += fmt::format("<li>{}</li>\n", escape_markup(note));
    body += "</ul>\n";
  }
  body += viewer(scene) + methods_list(scene);
  return web_page(scene.name + ": accuracy against time", body);
}

std::string chart_index(const std::vector<ChartScene>& scenes) {
  std::vector<std::string> names;
  for (const ChartScene& scene : scenes)
    for (const ChartLine& line : scene.lines)
      if (std::find(names.begin(), names.end(), line.name) == names.end())
        names.push_back(line.name);
  std::string body = fmt::format(
      "<h1>Accuracy against time</h1>\n<p class=\"soft\">Efficiency, 1 / (trimmed relMSE · CPU "
      "seconds), relative to the best method of each scene.</p>\n"
      "<div class=\"card scroll\"><table>\n<tr><th>scene</th>");
  for (size_t i = 0; i < names.size(); ++i) body += fmt::format("<th>{}</th>", swatch(i, names[i]));
  body += "</tr>\n";
  std::vector<double> logs(names.size()), counts(names.size());
  for (const ChartScene& scene : scenes) {
    body +=
        fmt::format("<tr><td><a href=\"{0}/index.html\">{0}</a></td>", escape_markup(scene.name));
    for (size_t i = 0; i < names.size(); ++i) {
      const auto line = std::find_if(scene.lines.begin(), scene.lines.end(),
                                     [&](const ChartLine& l) { return l.name == names[i]; });
      const auto e = line == scene.lines.end() ? std::nullopt : efficiency(*line);
      if (!e) {
        body += "<td>–</td>";
        continue;
      }
      const double ratio = e->value / best_efficiency(scene);
      logs[i] += std::log(ratio), counts[i] += 1;
      body += fmt::format("<td{}>{:.2f}</td>", ratio == 1 ? " class=\"best\"" : "", ratio);
    }
    body += "</tr>\n";
  }
  body += "<tr><td class=\"soft\">geometric mean</td>";
  for (size_t i = 0; i < names.size(); ++i)
    body += counts[i] > 0 ? fmt::format("<td>{:.2f}</td>", std::exp(logs[i] / counts[i]))
                          : "<td>–</td>";
  body += "</tr>\n</table></div>\n<div class=\"charts\">\n";
  for (const ChartScene& scene : scenes)
    body += fmt::format("<a href=\"{}/index.html\">{}</a>\n", escape_markup(scene.name),
                        embedded(chart_svg(scene, ChartAxis::cpu_seconds)));
  body += fmt::format("</div>\n<h2>How this was made</h2>\n<pre>{}</pre>\n",
                      escape_markup(command_line));
  return web_page("Accuracy against time", body);
}

}  // namespace duet
