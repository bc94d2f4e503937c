// The page of several scenes.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "evaluate/chart/colours.h"
#include "evaluate/chart/page.h"
#include "evaluate/chart/svg.h"
#include "evaluate/web/page.h"

namespace duet {

namespace {

/// The names of all lines of all scenes, each once.
std::vector<std::string> line_names(const std::vector<ChartScene>& scenes) {
  std::vector<std::string> names;
  for (const ChartScene& scene : scenes)
    for (const ChartLine& line : scene.lines)
      if (std::find(names.begin(), names.end(), line.name) == names.end())
        names.push_back(line.name);
  return names;
}

/// Efficiencies relative to the best of each scene.
class RatioTable {
 public:
  explicit RatioTable(const std::vector<ChartScene>& scenes)
      : names_(line_names(scenes)), logs_(names_.size()), counts_(names_.size()) {
    for (const ChartScene& scene : scenes) add(scene);
  }

  std::string html() const {
    std::string html =
        "<div class=\"card scroll\"><table class=\"sortable\">\n<thead><tr><th>scene</th>";
    for (size_t i = 0; i < names_.size(); ++i)
      html += fmt::format("<th><span class=\"swatch {}\"></span>{}</th>", series_class(i),
                          escape_markup(names_[i]));
    html += "<th class=\"text\">reference</th></tr></thead>\n<tbody>\n" + rows_ +
            "</tbody>\n<tfoot><tr><td class=\"soft\">geometric mean</td>";
    for (size_t i = 0; i < names_.size(); ++i)
      html += counts_[i] > 0 ? fmt::format("<td>{:.2f}</td>", std::exp(logs_[i] / counts_[i]))
                             : "<td>–</td>";
    return html + "<td></td></tr></tfoot>\n</table></div>\n";
  }

 private:
  void add(const ChartScene& scene) {
    rows_ += fmt::format("<tr><td class=\"name\"><a href=\"{0}/index.html\">{0}</a></td>",
                         escape_markup(scene.name));
    const std::vector<size_t> best = most_efficient(scene);
    for (size_t i = 0; i < names_.size(); ++i) {
      const auto line = std::find_if(scene.lines.begin(), scene.lines.end(),
                                     [&](const ChartLine& l) { return l.name == names_[i]; });
      const auto e = line == scene.lines.end() ? std::nullopt : efficiency(*line);
      if (!e) {
        rows_ += "<td class=\"none\">–</td>";
        continue;
      }
      const double ratio = e->value / best_efficiency(scene);
      logs_[i] += std::log(ratio), counts_[i] += 1;
      rows_ += fmt::format("<td{} data-value=\"{:.9g}\">{:.2f}</td>",
                           best_mark(best, size_t(line - scene.lines.begin()), scene.lines.size()),
                           ratio, ratio);
    }
    rows_ +=
        fmt::format("<td class=\"text\">{}</td></tr>\n", escape_markup(scene.reference_source));
  }

  std::vector<std::string> names_;
  std::vector<double> logs_, counts_;
  std::string rows_;
};

}  // namespace

std::string chart_index(const std::vector<ChartScene>& scenes, const std::string& command_line) {
  std::string body =
      "<h1>Accuracy against time</h1>\n<p class=\"soft\">Efficiency, 1 / (trimmed relMSE · CPU "
      "seconds), relative to the largest one of each scene. <span class=\"best\">Bold</span> is "
      "the "
      "best if no other 95 % interval overlaps its own; otherwise those that may be the best are "
      "<span class=\"tied\">underlined</span>.</p>\n" +
      RatioTable(scenes).html() + "<div class=\"charts\">\n";
  for (const ChartScene& scene : scenes)
    body += fmt::format("<a href=\"{}/index.html\"><figure>{}</figure></a>\n",
                        escape_markup(scene.name), chart_svg(scene, ChartAxis::cpu_seconds));
  body += fmt::format("</div>\n<h2>How this was made</h2>\n<pre>{}</pre>\n",
                      escape_markup(command_line));
  return web_page("Accuracy against time", body);
}

}  // namespace duet
