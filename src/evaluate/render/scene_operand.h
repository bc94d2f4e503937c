// What may stand on the command line in the place of a scene file: a folder, or "-".
#pragma once

#include <string>
#include <vector>

namespace duet {

/// The name that a scene from standard input has everywhere: in messages, headers and statistics.
inline const std::string kStandardInput = "<stdin>";

/// The scene file that an operand means: "-" is kStandardInput; a folder is the scene.xml in it, or
/// its only .xml file. Everything else, also a folder with no such file, stays as it is.
std::string scene_file_of(const std::string& operand);

/// Why there is no scene in that file, with what might have been meant: empty if it can be read.
/// `standard_input` is what was read from there.
std::string no_scene_reason(const std::string& file, const std::string& standard_input);

/// Standard input to its end if a scene comes from there, or "". Throws UsageError if two do, and
/// std::runtime_error if that fails.
std::string read_standard_input(const std::vector<std::string>& scene_files);

}  // namespace duet
