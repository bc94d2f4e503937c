// The files that images are written to: formats by the extension, and their bytes.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "evaluate/report/file_settings.h"
#include "evaluate/report/header.h"
#include "evaluate/report/image_form.h"
#include "image/image.h"

namespace duet {

/// The format that images of such a name are written in: "exr", "png", "jpg" or, for all others,
/// "".
std::string image_format(const std::string& path);
/// Whether the path's extension is that of a format for display: png, jpg or jpeg.
bool is_display_format(const std::string& path);

/// An image (channels R, G, B, A first, if it has colours) as the file whose name is `path`, which
/// must have a format. Throws std::runtime_error, which names `path`, and std::invalid_argument as
/// channels_in() does.
std::vector<uint8_t> image_file_bytes(const std::string& path, const Image& image,
                                      const ImageForm& form, const HeaderFields& header,
                                      const FileSettings& settings = {});

}  // namespace duet
