// Images that are not finished: what they are called, how they are told from finished ones, and
// when they go.
#pragma once

#include <string>

namespace duet {

/// "folder/image.partial.exr" for "folder/image.exr".
std::string partial_path(const std::string& path);

/// Empty if a file is a finished image that goes on to its end and was made with the settings of
/// this fingerprint; otherwise what is wrong with it, as in "it is empty".
std::string unfinished_reason(const std::string& path, const std::string& settings_hash);

/// Removes the partial image beside a finished one if it says of itself that it is one of this
/// scene. What it says otherwise is not ours to remove.
void remove_partial(const std::string& path, const std::string& scene);

}  // namespace duet
