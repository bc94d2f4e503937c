#include "evaluate/stability/run.h"

#include <fmt/format.h>

namespace duet::stability {

std::vector<RowResult> run(const Catalogue& catalogue, const Selection& selection, int threads,
                           const RunEvents& events) {
  std::vector<RowResult> results;
  for (const Row* row : selection.rows) {
    RowResult& result = results.emplace_back(RowResult{row, {}});
    events.row(*row, results.size());
    if (!row->planned.empty()) continue;
    Laboratory laboratory(threads, events.cancelled);
    for (const std::string& method : selection.methods) {
      result.cells.push_back(
          judge(catalogue, *row, method, laboratory, selection.fast ? kFastFactor : 1));
      events.judged(*row, result.cells.back());
    }
  }
  return results;
}

double seconds_of(const std::vector<RowResult>& results) {
  double seconds = 0;
  for (const RowResult& result : results)
    for (const CellResult& cell : result.cells) seconds += cell.seconds;
  return seconds;
}

bool is_as_expected(const std::vector<RowResult>& results) {
  return count(results, Outcome::unexpected) + count(results, Outcome::not_resolved) == 0;
}

std::string row_list(const std::vector<const Row*>& rows) {
  std::string text;
  for (const Row* row : rows)
    text += fmt::format("{:>3} {:22} {:6} {}\n", row->number > 0 ? fmt::to_string(row->number) : "",
                        row->name,
                        !row->planned.empty() ? "planned"
                        : row->fast           ? "fast"
                                              : "",
                        row->title);
  return text;
}

std::string summary(const std::vector<RowResult>& results, bool fast) {
  const int unresolved = count(results, Outcome::not_resolved);
  const int expected = count(results, Outcome::holds) + count(results, Outcome::fails_as_known);
  std::string text = fmt::format("{} of {} cells as expected", expected,
                                 expected + count(results, Outcome::unexpected) + unresolved);
  if (unresolved > 0) text += fmt::format(", {} not resolved", unresolved);
  text += "\n";
  if (fast)
    text +=
        fmt::format("the bounds of what is noticed are {:g} times as coarse as in the whole run\n",
                    kFastFactor);
  return text;
}

}  // namespace duet::stability
