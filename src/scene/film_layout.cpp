#include "scene/film_layout.h"

#include <fmt/format.h>

#include <stdexcept>

namespace duet {

FilmLayout film_layout(FilmDescription& film, const std::optional<Point2i>& size,
                       const std::optional<PixelBounds>& crop) {
  if (size) {
    film.width = size->x, film.height = size->y;
    film.crop.reset();
  }
  PixelBounds window{0, 0, film.width, film.height};
  if (film.crop)
    window = {film.crop->x, film.crop->y, film.crop->x + film.crop->width,
              film.crop->y + film.crop->height};
  if (crop) {
    window = *crop;
    if (window.x1 > film.width || window.y1 > film.height)
      throw std::out_of_range(
          fmt::format("the window reaches beyond the image of {}x{}", film.width, film.height));
  }
  return {{film.width, film.height}, window,        film.filter,
          film.crop && !crop,        film.response, film.sample_limit};
}

}  // namespace duet
