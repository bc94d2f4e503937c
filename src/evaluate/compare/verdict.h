// The verdict of a comparison in words.
#pragma once

#include <string>

#include "evaluate/compare/compare.h"

namespace duet {

/// What is known whatever is required: how far the image is from the reference, and whether noise
/// explains it.
std::string known_text(const Comparison& comparison);
/// The verdict with what belongs to it.
std::string verdict_text(const Comparison& comparison);

/// The test for bias: where the largest difference is and what would have been noticed; two lines.
std::string bias_test_text(const BiasTest& test);

/// What makes figures of these two images misleading, or "".
std::string clipping_warning(const LinearImage& image, const LinearImage& reference);
/// That tests for bias are not for this image, if it was denoised, or "".
std::string denoised_warning(const LinearImage& image);

}  // namespace duet
