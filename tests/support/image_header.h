// What image files say of themselves.
#pragma once

#include <string>

#include "image/image_io.h"

namespace duet::test {

/// A field of the header, or `otherwise`.
inline std::string header_field(const ImageFile& file, const std::string& name,
                                const std::string& otherwise = "") {
  for (const auto& [key, value] : file.header)
    if (key == name) return value;
  return otherwise;
}

}  // namespace duet::test
