// The outcomes of comparisons as a page.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "base/percent.h"
#include "evaluate/compare/compare.h"
#include "evaluate/compare/verdict.h"

namespace duet {

namespace {

/// The class of a verdict's badge.
std::string badge_class(const std::string& verdict) {
  std::string text;
  for (const char c : verdict)
    text += std::isalnum(uint8_t(c)) ? char(std::tolower(uint8_t(c))) : '-';
  return text;
}

std::string badge(const Comparison& c) {
  const std::string text = outcome_name(c);
  return fmt::format("<span class=\"badge {}\">{}</span>", badge_class(text), escape_markup(text));
}

/// A cell that is sorted by all of its digits and shows some of them.
std::string cell(const std::optional<double>& value, int digits) {
  if (!value || std::isnan(*value)) return "<td class=\"none\">–</td>";
  if (std::isinf(*value))
    return fmt::format("<td data-value=\"{}Infinity\">{}∞</td>", *value < 0 ? "-" : "",
                       *value < 0 ? "−" : "");
  return fmt::format("<td data-value=\"{:.9g}\">{:.{}g}</td>", *value, *value, digits);
}

/// The figures of the table: what most people look at, if it is there, and what is required.
std::vector<std::string> columns(const CompareSettings& o, const std::vector<Comparison>& all) {
  static constexpr const char* usual[] = {"relrmse", "trimmed", "worst", "flip", "hdrflip",
                                          "psnr",    "ssim",    "ratio", "p"};
  std::vector<std::string> names;
  const std::vector<Figure> known = figures({});
  for (size_t i = 0; i < known.size(); ++i) {
    const auto has = [&](const Comparison& c) {
      return c.compared() && figures(c.measurements)[i].value.has_value();
    };
    const auto required = [&](const Requirement& r) { return r.figure == known[i].name; };
    const bool is_usual =
        std::find(std::begin(usual), std::end(usual), known[i].name) != std::end(usual);
    if ((is_usual && std::any_of(all.begin(), all.end(), has)) ||
        std::any_of(o.requirements.begin(), o.requirements.end(), required))
      names.push_back(known[i].name);
  }
  return names;
}

/// Calls `use(figure)` for each of these figures.
template <class Use>
void for_each_figure(const Measurements& m, const std::vector<std::string>& names, Use use) {
  for (const Figure& f : figures(m))
    if (std::find(names.begin(), names.end(), f.name) != names.end()) use(f);
}

std::string row(const CompareSettings& o, const Comparison& c, size_t number,
                const std::vector<std::string>& columns) {
  std::string html = fmt::format("<tr data-verdict=\"{}\">", escape_markup(outcome_name(c)));
  const std::string name = escape_markup(c.name);
  if (!c.compared())
    return html + fmt::format(
                      "<td class=\"name\">{}</td><td class=\"text\">{}</td>"
                      "<td class=\"text\" colspan=\"{}\">{}</td></tr>\n",
                      name, badge(c), columns.size() + 1, escape_markup(absence(o, c)));
  html += fmt::format("<td class=\"name\"><a href=\"#i{}\">{}</a></td><td class=\"text\">{}</td>",
                      number, name, badge(c));
  for_each_figure(c.measurements, columns, [&](const Figure& f) { html += cell(f.value, 3); });
  std::string missed;
  for (const Requirement& r : c.missed) missed += (missed.empty() ? "" : " ") + r.text;
  return html + fmt::format("<td class=\"text\">{}</td></tr>\n", escape_markup(missed));
}

std::string table(const CompareSettings& o, const std::vector<Comparison>& all) {
  const std::vector<std::string> names = columns(o, all);
  std::string html =
      "<div class=\"bar filter\" data-table=\"outcomes\"></div>\n<div class=\"card scroll\">"
      "<table class=\"sortable\" id=\"outcomes\">\n<thead><tr><th>image</th>"
      "<th class=\"text\">verdict</th>";
  for_each_figure({}, names, [&](const Figure& f) {
    html += fmt::format("<th title=\"{}\">{}</th>", escape_markup(f.formula), f.name);
  });
  html += "<th class=\"text\">missed</th></tr></thead>\n<tbody>\n";
  for (size_t i = 0; i < all.size(); ++i) html += row(o, all[i], i, names);
  return html + "</tbody></table></div>\n";
}

std::string all_figures(const Comparison& c) {
  std::string html =
      "<details><summary>All figures</summary>\n<div class=\"scroll\"><table>\n"
      "<tr><th>figure</th><th>value</th><th class=\"text\">formula</th></tr>\n";
  for (const Figure& f : figures(c.measurements))
    html += fmt::format("<tr><td>{}</td>{}<td class=\"text\">{}</td></tr>\n", f.name,
                        cell(f.value, 6), escape_markup(f.formula));
  return html + "</table></div></details>\n";
}

std::string tile_text(const TileComparison& t) {
  return fmt::format(
      "<p>{} of {} tiles differ; mean z² {:.2f} (1 if only noise differs); ratio of the means "
      "{:.5f} ± "
      "{:.5f}. A bias of {} of half the tiles, and of {} of any, would have been "
      "noticed with a probability of 80 %.</p>\n",
      t.rejected, t.tiles, t.mean_z2, t.ratio, t.ratio_error, percent(t.visible_bias),
      percent(t.visible_bias_worst));
}

/// What there is to see of one comparison.
std::string details(const Comparison& c, size_t number) {
  std::string html =
      fmt::format("<section data-verdict=\"{}\">\n<h2 id=\"i{}\">{} {}</h2>\n",
                  escape_markup(outcome_name(c)), number, escape_markup(c.name), badge(c));
  if (!c.missed.empty()) html += fmt::format("<p>{}</p>\n", escape_markup(missed_text(c)));
  html += fmt::format("<p>{}</p>\n", escape_markup(known_text(c)));
  if (!c.warning.empty()) html += fmt::format("<p>Warning: {}.</p>\n", escape_markup(c.warning));
  if (c.measurements.bias_test)
    html += fmt::format("<p>{}</p>\n", escape_markup(bias_test_text(*c.measurements.bias_test)));
  if (c.measurements.tiles) html += tile_text(*c.measurements.tiles);
  return html + "<div class=\"card\">" + viewer_html(c.images, 1) + "</div>\n" + all_figures(c) +
         "</section>\n";
}

}  // namespace

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

std::string compare_page(const CompareSettings& o, const std::vector<Comparison>& all,
                         const std::string& command_line) {
  std::string body =
      fmt::format("<h1>{} against {}</h1>\n<p class=\"soft\">{}.</p>\n", escape_markup(o.image),
                  escape_markup(o.reference), escape_markup(summary_of(o, all)));
  if (!o.requirements.empty() || o.require_complete)
    body += fmt::format("<p>Required: <code>{}{}</code></p>\n",
                        escape_markup(fmt::format("{}", fmt::join(texts_of(o.requirements), "  "))),
                        o.require_complete ? "  --require-complete" : "");
  body += table(o, all);
  for (size_t i = 0; i < all.size(); ++i)
    if (all[i].compared()) body += details(all[i], i);
  body += fmt::format("<h2>How this was made</h2>\n<pre>{}</pre>\n{}<pre>{}</pre>\n",
                      escape_markup(command_line), viewer_keys(), escape_markup(figures_help()));
  return web_page(fmt::format("{} against {}", o.image, o.reference), body);
}

}  // namespace duet
