// What can be known of outputs before any scene is read.
#pragma once

#include "evaluate/render/file_uses.h"
#include "evaluate/render/render_options.h"

namespace duet {

/// Throws UsageError if the options about raw films, and about parts of the samples, do not go
/// together or with the others.
void check_parts(const RenderOptions& options);

/// Throws UsageError if the file that this option of the command line names cannot be written;
/// makes the directories in which it is to be. "" is no file.
void check_writable(const std::string& option, const std::string& path);

/// Throws UsageError if two images or raw films would be written to one file, or to one of `uses`,
/// those that the call names otherwise; if a name cannot be known, or if standard output cannot
/// hold what it is to hold. Returns the names of the first scene's images.
std::vector<std::string> check_outputs(const RenderOptions& options, FileUses uses);

}  // namespace duet
