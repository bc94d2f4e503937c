// What an image may tell of where and when it was made: nothing of the machine or the user.
#pragma once

#include <string>
#include <vector>

namespace duet {

/// A command line's argument without the folders of this machine: an absolute path (also after an
/// equals sign or a short option) becomes relative if it lies below the current folder, and
/// otherwise loses its folders.
std::string host_free(const std::string& argument);
std::vector<std::string> host_free(std::vector<std::string> arguments);

/// Now, or what SOURCE_DATE_EPOCH (https://reproducible-builds.org/specs/source-date-epoch) says
/// instead, as "2024-05-31T12:00:00Z".
std::string image_date();
/// Whether SOURCE_DATE_EPOCH asks for files that are equal whenever they are made.
bool is_reproducible();

}  // namespace duet
