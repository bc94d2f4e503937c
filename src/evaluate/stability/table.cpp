#include "evaluate/stability/table.h"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>

namespace duet::stability {

double limit_of(const Row& row) {
  return row.limit.value_or(find_check(row.check).limit);
}

double margin_of(const Row& row) {
  return row.margin.value_or(find_check(row.check).margin.value_or(0));
}

namespace {

std::string format_number(Unit unit, double value) {
  switch (unit) {
    case Unit::percent:
      return std::abs(value) < 1e-3 && value != 0 ? fmt::format("{:.1g} %", 100 * value)
             : std::abs(value) < 0.0995           ? fmt::format("{:.2f} %", 100 * value)
                                                  : fmt::format("{:.1f} %", 100 * value);
    case Unit::number:
      return fmt::format("{:.3g}", value);
    case Unit::count:
      return fmt::format("{:.0f}", value);
  }
  return "";
}

}  // namespace

std::string format_value(const Row& row, double value) {
  return format_number(find_check(row.check).unit, value);
}

std::string measured_text(const Row& row, const Measurement& measured) {
  std::string text = format_value(row, measured.value);
  if (measured.error > 0) text += " ± " + format_value(row, measured.error);
  return text;
}

std::string remark(const CellResult& cell) {
  std::string text = cell.measured.detail;
  if (!cell.why.empty()) text += (text.empty() ? "" : ". ") + cell.why;
  return text;
}

std::string describe_limit(const Row& row) {
  const Check& check = find_check(row.check);
  std::string text;
  // That of the tiles is a number, whatever the unit of what is measured.
  const Unit unit = row.check == "tiles" ? Unit::number : check.unit;
  if (check.limit_text)
    text =
        "limit: " + fmt::format(fmt::runtime(check.limit_text), format_number(unit, limit_of(row)));
  if (check.margin)
    text += fmt::format("{}methods that merge may be off by {}", text.empty() ? "" : "; ",
                        format_number(Unit::percent, margin_of(row)));
  return text;
}

bool is_exact(const Power& power) {
  return power.noise == 0 && power.noticed == power.required;
}

std::string describe_power(const Row& row, const Power& power) {
  if (is_exact(power)) return "exact";
  return fmt::format("{} (bound {})", format_value(row, power.noticed),
                     format_value(row, power.required));
}

CellResult judge(const Catalogue& catalogue, const Row& row, const std::string& method,
                 Laboratory& laboratory, double coarser) {
  const Expectation& expected = row.methods.at(method);
  CellResult result;
  result.method = method;
  result.why = expected.why;
  if (expected.verdict == Expected::not_applicable) return result;
  const auto start = std::chrono::steady_clock::now();
  const double level = sidak(kTableLevel, catalogue.measured_cells());
  result.measured =
      find_check(row.check).measure({row, method, laboratory, level, limit_of(row), margin_of(row),
                                     coarser, expected.verdict == Expected::fails});
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const Measurement& m = result.measured;
  if (expected.verdict == Expected::holds) {
    result.outcome = !m.holds              ? Outcome::unexpected
                     : !m.power.resolved() ? Outcome::not_resolved
                                           : Outcome::holds;
    if (!m.holds) result.why = "fails, but is expected to hold";
    return result;
  }
  // Written so that what is not a number is out of bounds.
  const bool within = m.value >= expected.least && m.value <= expected.most;
  result.outcome = !m.holds && within ? Outcome::fails_as_known : Outcome::unexpected;
  if (m.holds)
    result.why = "holds, but is known to fail";
  else if (!within)
    result.why = fmt::format("fails, but not by {} to {} as known",
                             format_value(row, expected.least), format_value(row, expected.most));
  return result;
}

int count(const std::vector<RowResult>& results, Outcome outcome) {
  int n = 0;
  for (const RowResult& r : results)
    for (const CellResult& c : r.cells) n += c.outcome == outcome;
  return n;
}

std::string describe(const Row& row, const CellResult& cell) {
  switch (cell.outcome) {
    case Outcome::holds:
      return "holds";
    case Outcome::fails_as_known: {
      const Expectation& e = row.methods.at(cell.method);
      return fmt::format("fails as known ({} to {})", format_value(row, e.least),
                         format_value(row, e.most));
    }
    case Outcome::not_applicable:
      return "not applicable";
    case Outcome::not_resolved:
      return "NOT RESOLVED: a greater deviation than the bound might go unnoticed";
    case Outcome::unexpected:
      return "NOT AS EXPECTED: " + cell.why;
  }
  return "";
}

std::string result_line(const Row& row, const CellResult& c) {
  const std::string line = fmt::format(
      "{:>3} {:22} {:8}", row.number > 0 ? fmt::to_string(row.number) : "", row.name, c.method);
  if (c.outcome == Outcome::not_applicable)
    return fmt::format("{} {:>20} {}", line, "", describe(row, c));
  const std::string value = measured_text(row, c.measured);
  // The sign is one column of two bytes.
  const size_t width = 20 + (c.measured.error > 0);
  return fmt::format("{} {:>{}} {}; notices {}{}", line, value, width, describe(row, c),
                     describe_power(row, c.measured.power),
                     c.measured.detail.empty() ? "" : "; " + c.measured.detail);
}

std::string json(const std::vector<RowResult>& results) {
  using Json = nlohmann::ordered_json;
  Json rows = Json::array();
  for (const RowResult& r : results) {
    Json row{{"name", r.row->name}, {"number", r.row->number}, {"title", r.row->title}};
    if (!r.row->planned.empty()) {
      row["planned"] = r.row->planned;
      rows.push_back(row);
      continue;
    }
    row["check"] = r.row->check;
    if (find_check(r.row->check).limit_text) row["limit"] = limit_of(*r.row);
    if (find_check(r.row->check).margin) row["margin"] = margin_of(*r.row);
    for (const CellResult& c : r.cells) {
      Json cell{{"method", c.method}, {"outcome", describe(*r.row, c)}};
      cell["as_expected"] = c.outcome != Outcome::unexpected && c.outcome != Outcome::not_resolved;
      if (!c.why.empty()) cell["why"] = c.why;
      if (c.outcome != Outcome::not_applicable) {
        cell["value"] = c.measured.value;
        cell["error"] = c.measured.error;
        cell["holds"] = c.measured.holds;
        cell["resolved"] = c.measured.power.resolved();
        cell["notices"] = c.measured.power.noticed;
        cell["has_to_notice"] = c.measured.power.required;
        cell["noise"] = c.measured.power.noise;
        cell["detail"] = c.measured.detail;
        cell["seconds"] = c.seconds;
      }
      row["cells"].push_back(cell);
    }
    rows.push_back(row);
  }
  return rows.dump(2) + "\n";
}

}  // namespace duet::stability
