// The stability table as a page of documentation.
#include <fmt/format.h>

#include <set>

#include "app/stability/table.h"

namespace duet::stability {

namespace {

std::string cell_text(const RowResult& r, const std::string& method) {
  for (const CellResult& c : r.cells) {
    if (c.method != method) continue;
    if (c.outcome == Outcome::not_applicable) return "–";
    const std::string value = format_value(*r.row, c.measured.value);
    if (c.outcome == Outcome::holds) return "✓ " + value;
    if (c.outcome == Outcome::fails_as_known) return "**✗ " + value + "**";
    return "**unexpected " + value + "**";
  }
  return "";
}

std::string number_text(const Row& row) {
  return row.number > 0 ? fmt::to_string(row.number) : "";
}

/// A row's own words, and every method that does not hold there with the reason.
std::string row_section(const RowResult& r) {
  const Row& row = *r.row;
  std::string text = fmt::format("### {}\n\n{}.", row.name, row.title);
  if (!row.about.empty()) text += " " + row.about;
  text += "\n\n";
  if (!row.planned.empty()) return text + "Planned: " + row.planned + "\n\n";
  text += fmt::format("Check `{}`, limit {}.\n\n", row.check, format_value(row, limit_of(row)));
  text += "| method | measured | verdict | |\n|---|---|---|---|\n";
  for (const CellResult& c : r.cells) {
    std::string measured = "–";
    if (c.outcome != Outcome::not_applicable) {
      measured = format_value(row, c.measured.value);
      if (c.measured.error > 0) measured += " ± " + format_value(row, c.measured.error);
    }
    std::string remark = c.measured.detail;
    if (!c.why.empty()) remark += (remark.empty() ? "" : ". ") + c.why;
    text += fmt::format("| {} | {} | {} | {} |\n", c.method, measured, describe(row, c), remark);
  }
  return text + "\n";
}

}  // namespace

std::string markdown(const Catalogue& catalogue, const std::vector<RowResult>& results,
                     const std::string& command) {
  std::string text = fmt::format(
      "# Stability: where methods fail\n\n"
      "Made by `{}`. Every row is a small scene in `scenes/stability/` on which renderers of this "
      "kind have failed; every column a method. `duet stability` measures all of it again, and "
      "exits with 1 if a method fails that should hold, holds where it is known to fail, or "
      "fails by another amount than is known. Seeds are fixed: the same program gives the same "
      "table.\n\n"
      "✓ holds; **✗ fails as known**: inherent in the method; – does not apply. The number is "
      "what the row's check measures, explained below the table.\n\n",
      command);
  text += "| # | row | what goes wrong |";
  for (const char* m : kMethods) text += fmt::format(" {} |", m);
  text += "\n|---|---|---|";
  for (size_t i = 0; i < kMethods.size(); ++i) text += "---|";
  text += "\n";
  for (const RowResult& r : results) {
    text += fmt::format("| {} | [{}](#{}) | {} |", number_text(*r.row), r.row->name, r.row->name,
                        r.row->title);
    for (const char* m : kMethods)
      text += fmt::format(" {} |", r.row->planned.empty() ? cell_text(r, m) : "planned");
    text += "\n";
  }
  text += fmt::format(
      "\n## Checks\n\n"
      "All tests together have a level of significance of {:g} %, shared by the {} cells (Šidák). "
      "Methods that merge are biased as long as their radius is not zero: in comparisons of means "
      "they hold if they differ by no more than a margin (5 % of a tile unless a row says "
      "otherwise).\n\n| check | what the number is | \n|---|---|\n",
      100 * kTableLevel, catalogue.measured_cells());
  std::set<std::string> used;
  for (const RowResult& r : results)
    if (r.row->planned.empty()) used.insert(r.row->check);
  for (const Check& c : checks())
    if (used.contains(c.name)) {
      const std::string limit = c.unit == Unit::percent ? fmt::format("{:g} %", 100 * c.limit)
                                                        : fmt::format("{:g}", c.limit);
      text += fmt::format(
          "| `{}` | {} |\n", c.name,
          fmt::format(fmt::runtime(c.summary),
                      std::string(c.name) == "tiles" ? fmt::format("{:g}", c.limit) : limit));
    }
  text += "\n## Rows\n\n";
  for (const RowResult& r : results) text += row_section(r);
  text.pop_back();
  return text;
}

}  // namespace duet::stability
