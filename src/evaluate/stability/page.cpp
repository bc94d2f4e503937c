// The stability table as a page for browsers.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "evaluate/stability/explanations.h"
#include "evaluate/stability/run.h"
#include "evaluate/stability/table.h"
#include "evaluate/web/page.h"

namespace duet::stability {

namespace {

/// Text with `code` and **strong** words, as HTML.
std::string marked(const std::string& text) {
  std::string html;
  bool code = false, strong = false;
  const auto toggle = [&html](bool& on, const char* element) {
    html += fmt::format("<{}{}>", on ? "/" : "", element);
    on = !on;
  };
  for (size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '`')
      toggle(code, "code");
    else if (!code && text.compare(i, 2, "**") == 0)
      toggle(strong, "strong"), ++i;
    else
      html += escape_markup(text.substr(i, 1));
  }
  if (code) html += "</code>";
  if (strong) html += "</strong>";
  return html;
}

struct Look {
  const char* verdict;  ///< in few words
  const char* badge;    ///< its class (page.css)
  const char* sign;     ///< what tells it from others without colours
};
Look look_of(Outcome outcome) {
  switch (outcome) {
    case Outcome::holds:
      return {"holds", "pass", "✓"};
    case Outcome::fails_as_known:
      return {"fails as known", "noisy", "✗"};
    case Outcome::not_resolved:
      return {"not resolved", "fail", "?"};
    case Outcome::unexpected:
      return {"not as expected", "fail", "!"};
    case Outcome::not_applicable:
      break;
  }
  return {"not applicable", "", "–"};
}

std::string badge(Outcome outcome, const std::string& text) {
  const Look look = look_of(outcome);
  return fmt::format("<span class=\"badge {}\">{} {}</span>", look.badge, look.sign,
                     escape_markup(text));
}

/// What matters most of the cells of a row.
std::string row_verdict(const RowResult& r) {
  if (!r.row->planned.empty()) return "planned";
  for (const Outcome o :
       {Outcome::unexpected, Outcome::not_resolved, Outcome::fails_as_known, Outcome::holds})
    if (std::any_of(r.cells.begin(), r.cells.end(),
                    [o](const CellResult& c) { return c.outcome == o; }))
      return look_of(o).verdict;
  return look_of(Outcome::not_applicable).verdict;
}

/// The methods that were run, in the order of the table.
std::vector<std::string> methods_of(const std::vector<RowResult>& results) {
  std::vector<std::string> methods;
  for (const char* method : kMethods)
    if (std::any_of(results.begin(), results.end(), [&](const RowResult& r) {
          return std::any_of(r.cells.begin(), r.cells.end(),
                             [&](const CellResult& c) { return c.method == method; });
        }))
      methods.push_back(method);
  return methods;
}

/// The attribute by which cells are sorted; those of numbers that are not finite sort by their
/// text.
std::string sorted_by(double value) {
  return std::isfinite(value) ? fmt::format(" data-value=\"{:.9g}\"", value) : "";
}

std::string overview_cell(const Row& row, const CellResult& c) {
  if (c.outcome == Outcome::not_applicable)
    return fmt::format("<td class=\"none\" title=\"{}\">–</td>", escape_markup(c.why));
  const Power& power = c.measured.power;
  return fmt::format(
      "<td{} title=\"{}\">{}<br><span class=\"interval\">{}</span></td>",
      sorted_by(c.measured.value), escape_markup("notices " + describe_power(row, power)),
      badge(c.outcome, format_value(row, c.measured.value)),
      is_exact(power) ? "exact" : escape_markup("notices " + format_value(row, power.noticed)));
}

std::string overview_row(const RowResult& r, const std::vector<std::string>& methods) {
  const Row& row = *r.row;
  std::string html = fmt::format(
      "<tr data-verdict=\"{0}\"><td class=\"name\"><a href=\"#{1}\">{1}</a>"
      "<div class=\"soft\"><small>{2}{3}</small></div></td>",
      row_verdict(r), escape_markup(row.name),
      row.number > 0 ? fmt::format("{}: ", row.number) : "", marked(row.title));
  if (!row.planned.empty())
    return html + fmt::format("<td class=\"text\" colspan=\"{}\">planned</td></tr>\n",
                              std::max<size_t>(methods.size(), 1));
  for (const std::string& method : methods) {
    const auto at = std::find_if(r.cells.begin(), r.cells.end(),
                                 [&](const CellResult& c) { return c.method == method; });
    html += at == r.cells.end() ? "<td class=\"none\"></td>" : overview_cell(row, *at);
  }
  return html + "</tr>\n";
}

std::string overview(const std::vector<RowResult>& results) {
  const std::vector<std::string> methods = methods_of(results);
  std::string html =
      "<div class=\"bar filter\" data-table=\"verdicts\"></div>\n<div class=\"card scroll\">"
      "<table class=\"sortable named\" id=\"verdicts\">\n<thead><tr><th>row</th>";
  for (const std::string& method : methods) html += fmt::format("<th>{}</th>", method);
  html += "</tr></thead>\n<tbody>\n";
  for (const RowResult& r : results) html += overview_row(r, methods);
  return html + "</tbody></table></div>\n";
}

std::string legend() {
  std::string html = "<p>";
  for (const Outcome o :
       {Outcome::holds, Outcome::fails_as_known, Outcome::not_resolved, Outcome::unexpected})
    html += badge(o, look_of(o).verdict) + " ";
  return html +
         "– does not apply. What fails as known does so because of the method. The number is what "
         "the row's check measures.</p>\n";
}

std::string detail_line(const Row& row, const CellResult& c) {
  if (c.outcome == Outcome::not_applicable)
    return fmt::format(
        "<tr><td>{}</td><td>–</td><td>–</td><td class=\"text\">not applicable</td>"
        "<td class=\"text\">{}</td></tr>\n",
        c.method, marked(c.why));
  return fmt::format(
      "<tr><td>{}</td><td>{}</td><td>{}</td><td class=\"text\">{}</td>"
      "<td class=\"text\">{}</td></tr>\n",
      c.method, escape_markup(measured_text(row, c.measured)),
      escape_markup(describe_power(row, c.measured.power)), marked(describe(row, c)),
      marked(remark(c)));
}

/// A row's own words, and its cells in full.
std::string details(const RowResult& r) {
  const Row& row = *r.row;
  std::string html =
      fmt::format("<section data-verdict=\"{0}\">\n<h2 id=\"{1}\">{1}</h2>\n<p>{2}. {3}</p>\n",
                  row_verdict(r), escape_markup(row.name), marked(row.title), marked(row.about));
  if (!row.planned.empty())
    return html + fmt::format("<p>Planned: {}</p>\n</section>\n", marked(row.planned));
  const std::string limit = describe_limit(row);
  html += fmt::format("<p class=\"soft\">Check <code>{}</code>{}{}.</p>\n", row.check,
                      limit.empty() ? "" : "; ", escape_markup(limit));
  html +=
      "<div class=\"card scroll\"><table>\n<tr><th>method</th><th>measured</th><th>notices</th>"
      "<th class=\"text\">verdict</th><th class=\"text\"></th></tr>\n";
  for (const CellResult& c : r.cells) html += detail_line(row, c);
  return html + "</table></div>\n</section>\n";
}

std::string checks_section(const Catalogue& catalogue) {
  std::string html = fmt::format(
      "<h2>Checks</h2>\n<p>{}</p>\n<p>{}</p>\n<div class=\"card scroll\"><table>\n"
      "<tr><th>check</th><th class=\"text\">what the number is</th>"
      "<th class=\"text\">what is noticed</th></tr>\n",
      marked(about_level(catalogue)), marked(about_power()));
  for (const Check* c : used_checks(catalogue))
    html += fmt::format(
        "<tr><td><code>{}</code></td><td class=\"text\">{}</td><td class=\"text\">{}</td></tr>\n",
        c->name, marked(c->summary), marked(c->power));
  return html + "</table></div>\n";
}

}  // namespace

std::string page(const Catalogue& catalogue, const std::vector<RowResult>& results, bool fast,
                 const std::string& command_line) {
  const std::string title = "Stability: where methods fail";
  std::string facts = summary(results, fast);
  facts.pop_back();
  std::replace(facts.begin(), facts.end(), '\n', ';');
  std::string body = fmt::format("<h1>{}</h1>\n<p class=\"soft\">{}.</p>\n<p>{}</p>\n", title,
                                 escape_markup(facts), marked(about_table()));
  body += legend() + overview(results) + checks_section(catalogue);
  for (const RowResult& r : results) body += details(r);
  body += fmt::format("<h2>How this was made</h2>\n<pre>{}</pre>\n", escape_markup(command_line));
  return web_page(title, body);
}

}  // namespace duet::stability
