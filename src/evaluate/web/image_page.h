// A page that shows one image.
#pragma once

#include <string>

#include "evaluate/compare/linear_image.h"

namespace duet {

/// The layers of an image in a viewer, and what its header says. Sides above 2048 pixels are
/// reduced.
std::string image_page(const std::string& name, const LinearImage& image);

}  // namespace duet
