#include "evaluate/web/thumbnail.h"

#include <stdexcept>

#include "evaluate/compare/linear_image.h"
#include "evaluate/web/pixels.h"
#include "image/colours.h"
#include "image/image_io.h"
#include "scene/film_image.h"

namespace duet {

namespace {

Image reduced_colours(const Image& image, int longest) {
  const Colours colours(image);
  const int n = reduction(image.width, image.height, longest);
  Image small((image.width + n - 1) / n, (image.height + n - 1) / n, {"R", "G", "B", "A"});
  size_t next = 0;
  for_each_block(
      image.width, image.height, n,
      [&](size_t i) {
        return std::array<double, 3>{colours(i, 0), colours(i, 1), colours(i, 2)};
      },
      [&](const std::array<double, 3>& mean) {
        for (const double v : mean) small.data[next++] = float(v);
        small.data[next++] = 1;
      });
  return small;
}

}  // namespace

std::string thumbnail_uri(const std::string& file, int longest) {
  try {
    const Image small = reduced_colours(load_linear(file).image, longest);
    const auto shown = to_display<uint8_t>(small, {}, false, false);
    return "data:image/jpeg;base64," +
           base64(display_image_bytes("thumbnail.jpg", small.width, small.height, shown.channels,
                                      shown.values));
  } catch (const std::exception&) {
    // A report without this picture is better than none.
    return "";
  }
}

}  // namespace duet
