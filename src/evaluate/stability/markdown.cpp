// The stability table as a page of documentation.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <sstream>

#include "evaluate/stability/explanations.h"
#include "evaluate/stability/table.h"

namespace duet::stability {

namespace {

/// What is kept of a page that was made before: the lines of its tables by their first words, for
/// methods and rows that are not measured again.
class EarlierPage {
 public:
  explicit EarlierPage(const std::string& text) {
    std::istringstream in(text);
    std::string line, row;
    while (std::getline(in, line)) {
      if (line.starts_with("### ")) row = line.substr(4);
      if (line.starts_with("## ")) row.clear();
      if (!row.empty()) {
        sections_[row] += line + "\n";
        if (line.starts_with("| ")) lines_[row][second_word(line)] = line + "\n";
      } else if (const size_t name = line.find("](#"); line.starts_with("| ")) {
        if (name != std::string::npos)
          overview_[line.substr(name + 3, line.find(')', name) - name - 3)] = line;
      }
    }
  }
  bool has(const std::string& row) const { return sections_.contains(row); }
  /// The line of the first table.
  std::string overview(const std::string& row) const { return overview_.at(row) + "\n"; }
  /// The cell of the first table; "" if there is none.
  std::string cell(const std::string& row, size_t method) const {
    const auto at = overview_.find(row);
    if (at == overview_.end()) return "";
    // " | " divides cells; the first three are the number, the name and the title.
    std::vector<std::string> cells;
    std::string rest = at->second;
    for (size_t end; (end = rest.find(" |")) != std::string::npos; rest = rest.substr(end + 2))
      cells.push_back(rest.substr(0, end));
    if (cells.size() < 4 + method) return "";
    const std::string& cell = cells[3 + method];
    return cell.empty() ? "" : cell.substr(1);
  }
  std::string section(const std::string& row) const { return sections_.at(row); }
  /// The line of a method in the section of a row; "" if there is none.
  std::string line(const std::string& row, const std::string& method) const {
    const auto at = lines_.find(row);
    if (at == lines_.end()) return "";
    const auto line = at->second.find(method);
    return line == at->second.end() ? "" : line->second;
  }

 private:
  static std::string second_word(const std::string& line) {
    return line.substr(2, line.find(' ', 2) - 2);
  }
  std::map<std::string, std::string> overview_, sections_;
  std::map<std::string, std::map<std::string, std::string>> lines_;
};

std::string cell_text(const RowResult& r, const std::string& method) {
  for (const CellResult& c : r.cells) {
    if (c.method != method) continue;
    if (c.outcome == Outcome::not_applicable) return "–";
    const std::string value = format_value(*r.row, c.measured.value);
    if (c.outcome == Outcome::holds) return "✓ " + value;
    if (c.outcome == Outcome::fails_as_known) return "**✗ " + value + "**";
    if (c.outcome == Outcome::not_resolved) return "**not resolved " + value + "**";
    return "**unexpected " + value + "**";
  }
  return "";
}

std::string number_text(const Row& row) {
  return row.number > 0 ? fmt::to_string(row.number) : "";
}

/// The line of a cell in the section of its row.
std::string cell_line(const Row& row, const CellResult& c) {
  if (c.outcome == Outcome::not_applicable)
    return fmt::format("| {} | – | – | not applicable | {} |\n", c.method, c.why);
  return fmt::format("| {} | {} | {} | {} | {} |\n", c.method, measured_text(row, c.measured),
                     describe_power(row, c.measured.power), describe(row, c), remark(c));
}

/// A row's own words, and every method that does not hold there with the reason.
std::string row_section(const RowResult& r, const EarlierPage& earlier) {
  const Row& row = *r.row;
  std::string text = fmt::format("### {}\n\n{}.", row.name, row.title);
  if (!row.about.empty()) text += " " + row.about;
  text += "\n\n";
  if (!row.planned.empty()) return text + "Planned: " + row.planned + "\n\n";
  const std::string limit = describe_limit(row);
  text += fmt::format("Check `{}`{}{}.\n\n", row.check, limit.empty() ? "" : "; ", limit);
  text += "| method | measured | notices | verdict | |\n|---|---|---|---|---|\n";
  for (const std::string method : kMethods) {
    const auto at = std::find_if(r.cells.begin(), r.cells.end(),
                                 [&](const CellResult& c) { return c.method == method; });
    text += at != r.cells.end() ? cell_line(row, *at) : earlier.line(row.name, method);
  }
  return text + "\n";
}

std::string overview_line(const RowResult& r, const EarlierPage& earlier) {
  std::string text = fmt::format("| {} | [{}](#{}) | {} |", number_text(*r.row), r.row->name,
                                 r.row->name, r.row->title);
  for (size_t m = 0; m < kMethods.size(); ++m) {
    std::string cell = r.row->planned.empty() ? cell_text(r, kMethods[m]) : "planned";
    if (cell.empty()) cell = earlier.cell(r.row->name, m);
    text += fmt::format(" {} |", cell);
  }
  return text + "\n";
}

std::string introduction(const std::string& command) {
  return fmt::format(
      "# Stability: where methods fail\n\n"
      "Made by `{}`. {}\n\n"
      "✓ holds; **✗ fails as known**: inherent in the method; – does not apply. The number is "
      "what the row's check measures, explained below the table.\n\n",
      command, about_table());
}

std::string explanation(const Catalogue& catalogue) {
  std::string text = fmt::format(
      "\n## Checks\n\n{}\n\n{}\n\n"
      "| check | what the number is | what is noticed |\n|---|---|---|\n",
      about_level(catalogue), about_power());
  for (const Check* c : used_checks(catalogue))
    text += fmt::format("| `{}` | {} | {} |\n", c->name, c->summary, c->power);
  return text + "\n## Rows\n\n";
}

}  // namespace

std::string markdown(const Catalogue& catalogue, const std::vector<RowResult>& results,
                     const std::string& command, const std::string& earlier_page) {
  const EarlierPage earlier(earlier_page);
  std::string text = introduction(command) + "| # | row | what goes wrong |", sections;
  for (const char* m : kMethods) text += fmt::format(" {} |", m);
  text += "\n|---|---|---|";
  for (size_t i = 0; i < kMethods.size(); ++i) text += "---|";
  text += "\n";
  for (const Row& row : catalogue.rows) {
    const auto at = std::find_if(results.begin(), results.end(),
                                 [&](const RowResult& r) { return r.row == &row; });
    if (at != results.end()) {
      text += overview_line(*at, earlier);
      sections += row_section(*at, earlier);
    } else if (earlier.has(row.name)) {
      text += earlier.overview(row.name);
      sections += earlier.section(row.name);
      if (!sections.ends_with("\n\n")) sections += "\n";
    }
  }
  sections.pop_back();
  return text + explanation(catalogue) + sections;
}

}  // namespace duet::stability
