// The layers of an image as a viewer shows them.
#pragma once

#include <vector>

#include "evaluate/web/page.h"

namespace duet {

/// Channels whose names differ in their last part only, which is R, G, B or X, Y, Z (or small
/// letters, or red, green, blue), are one image; any other channel is a grey one. In the order of
/// the channels.
std::vector<ViewedImage> viewed_layers(const Image& image, int longest);

}  // namespace duet
