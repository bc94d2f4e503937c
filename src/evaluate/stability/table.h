// The stability table: rows by methods, measured and judged.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "evaluate/stability/checks.h"

namespace duet::stability {

enum class Outcome {
  holds,
  fails_as_known,
  not_applicable,
  not_resolved,  ///< nothing is found, but too great a deviation would not have been found either
  unexpected,    ///< fails where it should hold, holds where it should fail, or out of bounds
};

/// A cell that has been judged.
struct CellResult {
  std::string method;
  Outcome outcome = Outcome::not_applicable;
  Measurement measured;
  std::string why;  ///< what is unexpected, or why the method fails or does not apply
  double seconds = 0;
};

struct RowResult {
  const Row* row;
  std::vector<CellResult> cells;  ///< none if the row is planned
};

/// Measures a cell and compares with what is expected there. `coarser` is by how much coarser than
/// in the whole run the bounds of the power are.
CellResult judge(const Catalogue& catalogue, const Row& row, const std::string& method,
                 Laboratory& laboratory, double coarser = 1);

/// How often an outcome is among the results.
int count(const std::vector<RowResult>& results, Outcome outcome);

/// "+1.2 %", "0.34" or "3", by the unit of the row's statistic.
std::string format_value(const Row& row, double value);
/// What was measured, with its standard error where there is one.
std::string measured_text(const Row& row, const Measurement& measured);
/// Further figures of a cell, and why it is as it is.
std::string remark(const CellResult& cell);
/// "holds", "fails as known (-4 % to -1 %)", …
std::string describe(const Row& row, const CellResult& cell);
/// Both with what was measured and what would have been noticed, on one line for people.
std::string result_line(const Row& row, const CellResult& cell);
double limit_of(const Row& row);
double margin_of(const Row& row);
/// "below 5.00 %": the limit of the row and its margin, as far as it has them.
std::string describe_limit(const Row& row);
/// Whether any deviation beyond the limit is noticed.
bool is_exact(const Power& power);
/// "4.31 % (bound 5.00 %)": what the cell would have noticed, and had to.
std::string describe_power(const Row& row, const Power& power);

/// docs/stability.md: what the table says, in full. Rows and methods without results are taken from
/// `earlier`, a page that this function made before, or "".
std::string markdown(const Catalogue& catalogue, const std::vector<RowResult>& results,
                     const std::string& command, const std::string& earlier);
/// The same for a browser, of what was measured alone: one HTML file that opens from disk and needs
/// nothing else. Mentions the command that made it; `fast` as in Selection.
std::string page(const Catalogue& catalogue, const std::vector<RowResult>& results, bool fast,
                 const std::string& command_line);
/// The same for programs.
std::string json(const std::vector<RowResult>& results);

}  // namespace duet::stability
