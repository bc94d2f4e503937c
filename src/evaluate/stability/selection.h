// Which cells of the failure catalogue are measured.
#pragma once

#include <string>
#include <vector>

#include "evaluate/stability/catalogue.h"

namespace duet::stability {

/// Rows by their names or by the numbers of their failures, in the catalogue's order; all if none
/// is named. With `fast` those that are part of the short run. Throws std::out_of_range for a name
/// that is not there, or if nothing is left.
std::vector<const Row*> select_rows(const Catalogue& catalogue,
                                    const std::vector<std::string>& names, bool fast);

/// These methods, or all if none is named. Throws std::out_of_range for one that is not there.
std::vector<std::string> select_methods(const std::vector<std::string>& names);

}  // namespace duet::stability
