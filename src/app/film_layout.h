// The image's size and window, with what the command line says instead of the scene.
#pragma once

#include <optional>

#include "image/film.h"
#include "scene/description.h"

namespace duet {

/// `film` takes on the size, which also removes its own window. Throws UsageError for a window that
/// reaches beyond the image.
FilmLayout film_layout(FilmDescription& film, const std::optional<Point2i>& size,
                       const std::optional<PixelBounds>& crop);

}  // namespace duet
