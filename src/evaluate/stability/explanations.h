// What readers of the stability table have to know, in the words that all of its pages share. Words
// between `...` are code, those between **...** are strong, as in Markdown.
#pragma once

#include <string>
#include <vector>

#include "evaluate/stability/checks.h"

namespace duet::stability {

/// What rows and columns are, and when the command fails.
std::string about_table();
/// The level of significance of the tests, and what margins are for.
std::string about_level(const Catalogue& catalogue);
/// What “notices” means, and its bounds.
std::string about_power();
/// The statistics that rows of the catalogue use.
std::vector<const Check*> used_checks(const Catalogue& catalogue);

}  // namespace duet::stability
