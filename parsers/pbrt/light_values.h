// What the parameters of lights have in common: scale and power.
#pragma once

#include <functional>
#include <optional>

#include "pbrt/values.h"
#include "scene/texture_texels.h"

namespace duet::pbrt {

/// "scale", a colour in v3.
Spectrum scale_of(Values& v);

/// "power" or "illuminance"; nothing if the parameter is not given or not above zero: pbrt takes no
/// notice of it then.
std::optional<double> positive_of(Values& v, std::string_view name);

/// How the images of lights are decoded: v3 takes the numbers of all files as they are.
inline std::optional<double> gamma_of_lights(Version version) {
  return version == Version::v3 ? std::optional(1.0) : std::nullopt;
}

/// Multiplies `scale` so that the light has the power that "power" says, if that is given; `power`
/// is what it has with the image alone. An image that cannot be read is an error.
void scale_to_power(Values& v, Spectrum& scale, const BitmapTexture& image,
                    const std::function<double(const TextureTexels&)>& power);

/// The mean over all pixels and channels.
double mean_number(const TextureTexels& image);

/// The luminous power of an image of radiant intensity that is thrown through a frustum with `fov`
/// degrees across the image's shorter side.
double projected_power(const TextureTexels& image, double fov);

}  // namespace duet::pbrt
