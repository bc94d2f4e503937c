#include "evaluate/report/image_file.h"

#include "base/file_names.h"
#include "scene/film_image.h"

namespace duet {

namespace {

std::vector<uint8_t> exr_file(const std::string& path, const Image& image, const ImageForm& form,
                              const HeaderFields& header, const FileSettings& settings) {
  Image written = in_pixel_format(image, form.pixel_format);
  const std::vector<std::string> names = channels_in(settings.aov_names, written.channels);
  ExrOptions exr;
  exr.half = form.half;
  for (const std::string& exact : form.full_precision)
    if (const int c = written.find_channel(exact); c >= 0)
      exr.full_precision.push_back(names[size_t(c)]);
  exr.origin = {form.crop.x0, form.crop.y0};
  exr.full_size = form.full_size;
  exr.parts = settings.exr_parts;
  exr.header = header;
  written.channels = names;
  return exr_bytes(path, written, exr);
}

}  // namespace

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
                                      const FileSettings& settings) {
  if (!is_display_format(path)) return exr_file(path, image, form, header, settings);
  const DisplayOptions options{settings.display, form.tone_mapping, header_texts(header)};
  const bool is_png = image_format(path) == "png",
             with_alpha = is_png && has_alpha(form.pixel_format);
  const auto write = [&]<class Value>(Value) {
    const auto shown = to_display<Value>(image, options, is_grey(form.pixel_format), with_alpha);
    return display_image_bytes(path, image.width, image.height, shown.channels, shown.values,
                               options.fields);
  };
  return is_png && settings.display.png_depth == 16 ? write(uint16_t()) : write(uint8_t());
}

}  // namespace duet
