// The outcomes of comparisons as a page and as JUnit's XML.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "app/commands.h"
#include "app/compare.h"
#include "app/compare_verdict.h"

namespace duet {

namespace {

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return char(std::tolower(c)); });
  return text;
}

std::string badge(const Comparison& c) {
  const std::string text = c.failure.empty() ? name_of(c.verdict) : "ERROR";
  return fmt::format("<span class=\"badge {}\">{}</span>", lower(text), text);
}

std::string missed_text(const Comparison& c) {
  std::string text;
  const std::vector<Figure> all = figures(c.measurements);
  for (const Requirement& r : c.missed)
    for (const Figure& f : all)
      if (f.name == r.figure)
        text += fmt::format("{}{} is not met: {}", text.empty() ? "" : "; ", r.text,
                            f.value ? fmt::format("{:.6g}", *f.value) : "not available");
  return text;
}

std::string cell(const std::optional<double>& value) {
  return value ? fmt::format("<td>{:.4g}</td>", *value) : "<td>–</td>";
}

/// The columns of the table: what most people look at.
constexpr const char* kColumns[] = {"relrmse", "trimmed", "worst", "flip", "hdrflip", "ratio", "p"};

std::string table(const std::vector<Comparison>& all) {
  std::string html = "<div class=\"card scroll\"><table>\n<tr><th>image</th><th>verdict</th>";
  for (const char* column : kColumns) html += fmt::format("<th>{}</th>", column);
  html += "<th class=\"text\"></th></tr>\n";
  for (size_t i = 0; i < all.size(); ++i) {
    const Comparison& c = all[i];
    html += fmt::format("<tr><td><a href=\"#i{}\">{}</a></td><td>{}</td>", i, escape_markup(c.name),
                        badge(c));
    const std::vector<Figure> values = figures(c.measurements);
    for (const char* column : kColumns) {
      const auto f = std::find_if(values.begin(), values.end(),
                                  [&](const Figure& x) { return x.name == column; });
      html += cell(c.failure.empty() ? f->value : std::nullopt);
    }
    html += fmt::format("<td class=\"text\">{}</td></tr>\n",
                        escape_markup(c.failure.empty() ? missed_text(c) : c.failure));
  }
  return html + "</table></div>\n";
}

std::string tile_text(const TileComparison& t) {
  return fmt::format(
      "<p>{} of {} tiles differ; mean z² {:.2f} (1 if only noise differs); ratio of the means "
      "{:.5f} ± "
      "{:.5f}. A bias of {:.2g} % of half the tiles, and of {:.2g} % of any, would have been "
      "noticed with a probability of 80 %.</p>\n",
      t.rejected, t.tiles, t.mean_z2, t.ratio, t.ratio_error, 100 * t.visible_bias,
      100 * t.visible_bias_worst);
}

std::string details(const Comparison& c, size_t number) {
  std::string html =
      fmt::format("<h2 id=\"i{}\">{} {}</h2>\n", number, escape_markup(c.name), badge(c));
  if (!c.failure.empty()) return html + fmt::format("<p>{}</p>\n", escape_markup(c.failure));
  if (!c.missed.empty()) html += fmt::format("<p>{}</p>\n", escape_markup(missed_text(c)));
  html += fmt::format("<p>{}</p>\n", escape_markup(known_text(c)));
  if (!c.warning.empty()) html += fmt::format("<p>Warning: {}.</p>\n", escape_markup(c.warning));
  if (c.measurements.bias_test)
    html += fmt::format("<p>{}</p>\n", escape_markup(bias_test_text(*c.measurements.bias_test)));
  if (c.measurements.tiles) html += tile_text(*c.measurements.tiles);
  return html + "<div class=\"card\">" + viewer_html(c.images, 1) + "</div>\n";
}

size_t count_failures(const CompareOptions& o, const std::vector<Comparison>& all) {
  return size_t(std::count_if(all.begin(), all.end(),
                              [&](const Comparison& c) { return c.failure.empty() && !c.met(o); }));
}

size_t count_errors(const std::vector<Comparison>& all) {
  return size_t(std::count_if(all.begin(), all.end(),
                              [](const Comparison& c) { return !c.failure.empty(); }));
}

}  // namespace

std::string compare_page(const CompareOptions& o, const std::vector<Comparison>& all) {
  const size_t errors = count_errors(all), failures = count_failures(o, all);
  std::string body = fmt::format(
      "<h1>{} against {}</h1>\n<p class=\"soft\">{} compared, {} missed a threshold, {} could not "
      "be "
      "compared.</p>\n",
      escape_markup(o.image), escape_markup(o.reference), all.size() - errors, failures, errors);
  if (!o.require.empty())
    body += fmt::format("<p>Required: <code>{}</code></p>\n",
                        escape_markup(fmt::format("{}", fmt::join(o.require, "  "))));
  body += table(all);
  for (size_t i = 0; i < all.size(); ++i) body += details(all[i], i);
  body += fmt::format(
      "<h2>How this was made</h2>\n<pre>{}</pre>\n<p class=\"soft\">Keys: <kbd>1</kbd> "
      "<kbd>2</kbd> choose "
      "an image, <kbd>space</kbd> flips, <kbd>e</kbd> shows the error, <kbd>r</kbd> resets; the "
      "wheel "
      "zooms once the viewer was clicked.</p>\n<pre>{}</pre>\n",
      escape_markup(command_line), escape_markup(figures_help()));
  return web_page(fmt::format("{} against {}", o.image, o.reference), body);
}

std::string junit_report(const CompareOptions& o, const std::vector<Comparison>& all) {
  std::string xml = fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<testsuite name=\"duet compare {}\" tests=\"{}\" failures=\"{}\" errors=\"{}\">\n",
      escape_markup(o.reference), all.size(), count_failures(o, all), count_errors(all));
  for (const Comparison& c : all) {
    xml += fmt::format("  <testcase classname=\"{}\" name=\"{}\">\n", escape_markup(o.image),
                       escape_markup(c.name));
    if (!c.failure.empty()) {
      xml += fmt::format("    <error message=\"{}\"/>\n", escape_markup(c.failure));
    } else if (!c.met(o)) {
      const std::string why = c.missed.empty() ? "values that are not finite" : missed_text(c);
      xml += fmt::format("    <failure type=\"{}\" message=\"{}\"/>\n", name_of(c.verdict),
                         escape_markup(why));
    }
    xml += "    <system-out>";
    for (const Figure& f : figures(c.measurements))
      if (f.value && c.failure.empty()) xml += fmt::format("{} {:.6g}\n", f.name, *f.value);
    xml += "</system-out>\n  </testcase>\n";
  }
  return xml + "</testsuite>\n";
}

}  // namespace duet
