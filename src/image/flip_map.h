// The differences between two images on a display that an eye sees: the metric behind flip.h.
#pragma once

#include <array>
#include <vector>

namespace duet {

/// Linear sRGB from 0 to 1, row by row.
using FlipColours = std::vector<std::array<float, 3>>;

/// The difference of every pixel, from 0 to 1, of two images of this size. Source: Andersson et
/// al., "FLIP: A Difference Evaluator for Alternating Images", HPG 2020.
std::vector<float> flip_map(const FlipColours& image, const FlipColours& reference, int width,
                            int height);

}  // namespace duet
