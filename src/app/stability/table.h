// The stability table: rows by methods, measured and judged.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "app/stability/checks.h"

namespace duet::stability {

enum class Outcome {
  holds,
  fails_as_known,
  not_applicable,
  unexpected,  ///< fails where it should hold, holds where it should fail, or out of bounds
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

/// What to run of a catalogue.
struct Selection {
  std::vector<const Row*> rows;
  std::vector<std::string> methods;
};

/// Measures a cell and compares with what is expected there.
CellResult judge(const Catalogue& catalogue, const Row& row, const std::string& method,
                 Laboratory& laboratory);

bool all_as_expected(const std::vector<RowResult>& results);

/// "+1.2 %", "0.34" or "3", by the unit of the row's statistic.
std::string format_value(const Row& row, double value);
/// "holds", "fails as known (-4 % to -1 %)", …
std::string describe(const Row& row, const CellResult& cell);
double limit_of(const Row& row);

/// docs/stability.md: what the table says, in full.
std::string markdown(const Catalogue& catalogue, const std::vector<RowResult>& results,
                     const std::string& command);
/// The same for programs.
std::string json(const std::vector<RowResult>& results);

}  // namespace duet::stability
