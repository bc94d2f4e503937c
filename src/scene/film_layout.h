// The size and the window of an image, with what takes the place of those of the scene.
#pragma once

#include <optional>

#include "image/film.h"
#include "scene/description.h"

namespace duet {

/// `film` takes on the size, which also removes its own window; `crop` takes the place of that.
/// Throws std::out_of_range for one that reaches beyond the image.
FilmLayout film_layout(FilmDescription& film, const std::optional<Point2i>& size = {},
                       const std::optional<PixelBounds>& crop = {});

}  // namespace duet
