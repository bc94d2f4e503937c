// The files that list the jobs of `duet batch`.
#pragma once

#include <string>
#include <vector>

#include "evaluate/batch/job.h"

namespace duet::batch {

/// Reads a manifest: .csv with the names of the columns in its first row, or .jsonl with an object
/// in each line. A name is "scene", "output" or one of `options`. Values of repeatable options and
/// of "output" are parted by semicolons in CSV, and lists in JSON; flags are true or false. What is
/// empty, or null, is not given. Relative names of scenes, and of the folders of "path", are meant
/// from the manifest's folder.
///
/// All that is wrong is in `diagnostics`: an unknown or repeated name, a row with more or fewer
/// fields than columns, values of another form, text that is no CSV or JSON, a job without a scene,
/// no job at all, a file that cannot be read or has another extension.
std::vector<Job> read_manifest(const std::string& path, const std::vector<RenderOption>& options,
                               Diagnostics& diagnostics);

}  // namespace duet::batch
