// Goes through the catalogue: every row by every method, measured and judged.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "evaluate/stability/table.h"

namespace duet::stability {

/// What to run of a catalogue.
struct Selection {
  std::vector<const Row*> rows;
  std::vector<std::string> methods;
  bool fast = false;  ///< with bounds of what is noticed that are coarser by kFastFactor
};

/// Told of a run while it goes on. All three have to be set.
struct RunEvents {
  /// A row begins, or is passed over since it is planned; `number` counts from 1.
  std::function<void(const Row& row, size_t number)> row;
  std::function<void(const Row& row, const CellResult& cell)> judged;
  /// Asked again and again: whether to stop.
  std::function<bool()> cancelled;
};

/// The results of all rows; planned ones have none. Throws Laboratory::Cancelled.
std::vector<RowResult> run(const Catalogue& catalogue, const Selection& selection, int threads,
                           const RunEvents& events);

/// The time that all cells took.
double seconds_of(const std::vector<RowResult>& results);
/// Whether no cell is unexpected or not resolved.
bool is_as_expected(const std::vector<RowResult>& results);

/// A line for each row with its number, its name and its title.
std::string row_list(const std::vector<const Row*>& rows);
/// How many cells are as expected, for people.
std::string summary(const std::vector<RowResult>& results, bool fast);

}  // namespace duet::stability
