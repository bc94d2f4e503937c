#include "scene/film_layout.h"

#include <doctest/doctest.h>

#include <stdexcept>

using namespace duet;

TEST_CASE("the window of an image is that of the film, of the size, or the one asked for") {
  FilmDescription film;
  film.width = 40, film.height = 30;
  film.crop = {5, 6, 20, 10};
  const FilmLayout own = film_layout(film);
  CHECK(own.crop.x0 == 5);
  CHECK(own.crop.y1 == 16);
  CHECK(own.ends_at_crop);

  const FilmLayout window = film_layout(film, {}, PixelBounds{0, 0, 40, 30});
  CHECK(window.crop.width() == 40);
  CHECK(!window.ends_at_crop);
  CHECK_THROWS_AS(film_layout(film, {}, PixelBounds{0, 0, 41, 30}), std::out_of_range);

  const FilmLayout sized = film_layout(film, Point2i{64, 48});
  CHECK(sized.full.x == 64);
  CHECK(sized.crop.height() == 48);
  CHECK(film.width == 64);
  CHECK(!film.crop);
}
