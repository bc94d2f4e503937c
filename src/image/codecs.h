// Image formats other than OpenEXR, through a library that is loaded when the first such file
// comes.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "image/codec_module.h"
#include "image/image_io.h"

namespace duet {

/// The environment variable that says where the library is.
inline constexpr const char* kImageModuleVariable = "DUET_IMAGE_MODULE";

/// `kind` as in codec_module.h. Throws std::runtime_error, also if the library is not found.
ImageFile decode_with_module(const char* kind, const std::vector<uint8_t>& bytes);

}  // namespace duet
