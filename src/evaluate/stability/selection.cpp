#include "evaluate/stability/selection.h"

#include <fmt/ranges.h>

#include <algorithm>

#include "base/diagnostics.h"

namespace duet::stability {

std::vector<const Row*> select_rows(const Catalogue& catalogue,
                                    const std::vector<std::string>& names, bool fast) {
  const auto is_called = [](const Row& row, const std::string& name) {
    return row.name == name || (row.number > 0 && fmt::to_string(row.number) == name);
  };
  std::vector<std::string> known;
  for (const Row& row : catalogue.rows) known.push_back(row.name);
  for (const std::string& name : names)
    if (std::none_of(catalogue.rows.begin(), catalogue.rows.end(),
                     [&](const Row& row) { return is_called(row, name); }))
      throw std::out_of_range(
          fmt::format("there is no case \"{}\"{}; duet stability --list names them", name,
                      did_you_mean(name, known)));
  std::vector<const Row*> rows;
  for (const Row& row : catalogue.rows) {
    const bool named = std::any_of(names.begin(), names.end(),
                                   [&](const std::string& name) { return is_called(row, name); });
    if ((names.empty() || named) && (!fast || row.fast)) rows.push_back(&row);
  }
  if (rows.empty()) throw std::out_of_range("none of these cases is part of --fast");
  return rows;
}

std::vector<std::string> select_methods(const std::vector<std::string>& names) {
  const std::vector<std::string> known(kMethods.begin(), kMethods.end());
  if (names.empty()) return known;
  for (const std::string& name : names)
    if (std::find(known.begin(), known.end(), name) == known.end())
      throw std::out_of_range(fmt::format("there is no method \"{}\"{}; there are {}", name,
                                          did_you_mean(name, known), fmt::join(known, ", ")));
  return names;
}

}  // namespace duet::stability
