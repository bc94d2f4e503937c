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
std::string no_scene_reason(const std::string& file);

/// Reads standard input to its end if a scene comes from there. Throws UsageError if two do, and
/// std::runtime_error if that fails.
void read_standard_input(const std::vector<std::string>& scene_files);

/// What read_standard_input has read.
const std::string& standard_input();

}  // namespace duet
