// Reads a scene file, and those it includes, into a tree of plugins.
#pragma once

#include <string>

#include "mitsuba/mitsuba.h"
#include "mitsuba/node.h"
#include "values/report.h"

namespace duet {

/// Replaces parameters, follows includes, resolves references and aliases. Errors are in `report`;
/// what could be read is in the tree nevertheless, so that further errors can be found.
NodeTree load_tree(const std::string& file, const MitsubaOptions& options, const FileAccess& access,
                   Report& report);

}  // namespace duet
