// Small pictures of images.
#pragma once

#include <string>

namespace duet {

/// The image of a file as a JPEG in a data URI (RFC 2397), reduced by averaging until neither side
/// is longer than `longest`. "" if the file cannot be read or has no colours.
std::string thumbnail_uri(const std::string& file, int longest);

}  // namespace duet
