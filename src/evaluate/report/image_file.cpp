#include "evaluate/report/image_file.h"

#include "base/file_names.h"
#include "scene/film_image.h"

namespace duet {

std::string image_format(const std::string& path) {
  const std::string e = extension_of(path);
  if (e == ".exr" || e == ".png" || e == ".jpg") return e.substr(1);
  return e == ".jpeg" ? "jpg" : "";
}

bool is_display_format(const std::string& path) {
  const std::string format = image_format(path);
  return format == "png" || format == "jpg";
}

std::vector<uint8_t> image_file_bytes(const std::string& path, const Image& image,
                                      const ImageForm& form, const HeaderFields& header,
                                      const DisplaySettings& display) {
  if (!is_display_format(path)) {
    ExrOptions exr;
    exr.half = form.half;
    exr.full_precision = form.full_precision;
    exr.origin = {form.crop.x0, form.crop.y0};
    exr.full_size = form.full_size;
    exr.header = header;
    return exr_bytes(path, in_pixel_format(image, form.pixel_format), exr);
  }
  const DisplayOptions options{display, form.tone_mapping, header_texts(header)};
  const bool with_alpha = has_alpha(form.pixel_format) && image_format(path) == "png";
  const DisplayImage shown = to_display(image, options, is_grey(form.pixel_format), with_alpha);
  return display_image_bytes(path, image.width, image.height, shown.channels, shown.bytes,
                             options.fields);
}

}  // namespace duet
