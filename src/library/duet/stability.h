// Methods on the scenes where methods fail.
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace duet {

/// What `duet stability` can be told, with the same meaning.
struct StabilitySettings {
  std::vector<std::string> rows;     ///< of the catalogue, by name or number; all if none
  std::vector<std::string> methods;  ///< "path", "bdpt" …; all if none
  bool fast = false;                 ///< only the short run, whose bounds are coarser
  std::string catalogue;  ///< the folder with catalogue.json and its scenes; "": Duet's own
  int threads = 0;        ///< as in RenderSettings; the table is the same
};

enum class StabilityVerdict {
  holds,
  fails_as_known,
  not_applicable,
  not_resolved,  ///< nothing is found, but too great a deviation would not have been found either
  unexpected,    ///< fails where it should hold, holds where it should fail, or out of bounds
};

/// A row by a method. Numbers are in the unit of the row's check (docs/stability.md); shares are
/// fractions, not per cent.
struct StabilityCell {
  std::string row, method;
  StabilityVerdict verdict = StabilityVerdict::not_applicable;
  double value = 0;          ///< what the check measures
  double error = 0;          ///< its standard error, where there is one
  double notices = 0;        ///< the smallest deviation that would have been noticed
  double has_to_notice = 0;  ///< the bound for that
  std::string detail, why;   ///< further figures; why it fails or does not apply
  double seconds = 0;        ///< wall time that it took
};

/// What came of a run. It never changes; copies share what is behind them.
class [[gnu::visibility("default")]] StabilityTable {
 public:
  /// Row by row, in the order of the catalogue; none of rows that are only planned.
  const std::vector<StabilityCell>& cells() const;
  /// Whether no cell is unexpected or not resolved.
  bool is_as_expected() const;
  /// How many cells are as expected, for people.
  std::string summary() const;
  /// The file of `duet stability --json`.
  std::string json() const;
  /// The file of `duet stability --html`: it opens from disk and needs nothing else. `how_made` is
  /// shown as the command that made it.
  std::string page(const std::string& how_made) const;

  /// The library's own.
  struct Contents;
  explicit StabilityTable(std::shared_ptr<const Contents> contents)
      : contents_(std::move(contents)) {}

 private:
  std::shared_ptr<const Contents> contents_;
};

/// How a run is watched and stopped.
struct StabilityWatch {
  std::function<void(const StabilityCell&)> judged = {};  ///< from the calling thread
  const std::atomic<bool>* cancel = nullptr;              ///< to be set by any thread
};

/// Measures and judges these rows by these methods; nothing if it was cancelled. Throws FileError
/// for a catalogue that cannot be used and std::invalid_argument for rows or methods that there are
/// not.
[[gnu::visibility("default")]] std::optional<StabilityTable> check_stability(
    const StabilitySettings& settings, const StabilityWatch& watch = {});

}  // namespace duet
