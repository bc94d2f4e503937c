// Images without noise: what a denoiser needs of a render, and what is said of what it
// makes.
#pragma once

#include <string>
#include <vector>

#include "evaluate/report/header.h"
#include "image/denoiser.h"
#include "integrators/make_integrator.h"

namespace duet {

/// Adds the layers that guide the denoiser to those that a scene asks for. `override_with` is what
/// will take the place of its method. Returns the names of channels that are in the image only for
/// that: of layers that neither of the two names. Throws std::invalid_argument if the image will
/// have no colours.
std::vector<std::string> add_denoiser_layers(IntegratorDescription& integrator,
                                             const IntegratorOverride& override_with);

/// An image without some of its channels.
Image without_channels(const Image& image, const std::vector<std::string>& names);

/// The colours without noise, and alpha as it is, of an image that has the layers. If they tell how
/// noisy it is, the denoiser changes little where there is no noise (denoiser_bias.h). Throws
/// std::runtime_error if the denoiser fails.
Image denoised_image(const Denoiser& denoiser, const Image& image, bool tells_noise);

/// The header field that names the denoiser.
inline constexpr const char* kDenoiserField = "denoiser";

/// The header of the denoised image: that of the noisy one, with the denoiser's name and the bias.
HeaderFields denoised_header(HeaderFields header, const std::string& denoiser);

/// "folder/image.denoised.exr" for "folder/image.exr".
std::string denoised_path(const std::string& path);

}  // namespace duet
