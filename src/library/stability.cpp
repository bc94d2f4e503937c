#include "duet/stability.h"

#include <stdexcept>

#include "evaluate/stability/run.h"
#include "evaluate/stability/selection.h"
#include "library/contents.h"

namespace duet {

/// Results point to rows of the catalogue.
struct StabilityTable::Contents {
  stability::Catalogue catalogue;
  stability::Selection selection;
  std::vector<stability::RowResult> results;
  std::vector<StabilityCell> cells;
};

namespace {

StabilityVerdict verdict_of(stability::Outcome outcome) {
  switch (outcome) {
    case stability::Outcome::holds:
      return StabilityVerdict::holds;
    case stability::Outcome::fails_as_known:
      return StabilityVerdict::fails_as_known;
    case stability::Outcome::not_resolved:
      return StabilityVerdict::not_resolved;
    case stability::Outcome::unexpected:
      return StabilityVerdict::unexpected;
    case stability::Outcome::not_applicable:
      break;
  }
  return StabilityVerdict::not_applicable;
}

StabilityCell cell_of(const stability::Row& row, const stability::CellResult& c) {
  return {row.name,
          c.method,
          verdict_of(c.outcome),
          c.measured.value,
          c.measured.error,
          c.measured.power.noticed,
          c.measured.power.required,
          c.measured.detail,
          c.why,
          c.seconds};
}

void select(const StabilitySettings& settings, const stability::Catalogue& catalogue,
            stability::Selection& selection) {
  try {
    selection = {stability::select_rows(catalogue, settings.rows, settings.fast),
                 stability::select_methods(settings.methods), settings.fast};
  } catch (const std::out_of_range& e) {
    throw std::invalid_argument(e.what());
  }
}

}  // namespace

std::optional<StabilityTable> check_stability(const StabilitySettings& settings,
                                              const StabilityWatch& watch) {
  const auto made = std::make_shared<StabilityTable::Contents>();
  stability::RunEvents events;
  events.row = [](const stability::Row&, size_t) {};
  events.judged = [&](const stability::Row& row, const stability::CellResult& cell) {
    made->cells.push_back(cell_of(row, cell));
    if (watch.judged) watch.judged(made->cells.back());
  };
  events.cancelled = [&] { return watch.cancel && watch.cancel->load(); };
  try {
    made->catalogue = stability::read_catalogue(
        settings.catalogue.empty() ? stability::catalogue_folder() : settings.catalogue);
    select(settings, made->catalogue, made->selection);
    made->results =
        stability::run(made->catalogue, made->selection, threads_or_all(settings.threads), events);
  } catch (const stability::CatalogueError& e) {
    throw FileError(e.what());
  } catch (const stability::Laboratory::Cancelled&) {
    return std::nullopt;
  }
  return StabilityTable(made);
}

const std::vector<StabilityCell>& StabilityTable::cells() const {
  return contents_->cells;
}

bool StabilityTable::is_as_expected() const {
  return stability::is_as_expected(contents_->results);
}

std::string StabilityTable::summary() const {
  return stability::summary(contents_->results, contents_->selection.fast);
}

std::string StabilityTable::json() const {
  return stability::json(contents_->results);
}

std::string StabilityTable::page(const std::string& how_made) const {
  return stability::page(contents_->catalogue, contents_->results, contents_->selection.fast,
                         how_made);
}

}  // namespace duet
