#include "image/plain_jpeg.h"

#include <csetjmp>
// jpeglib.h needs these before it.
#include <cstddef>
#include <cstdio>

#include <jpeglib.h>

#include <new>

#include "image/image_limits.h"

namespace duet {

namespace {

/// libjpeg's state for one file.
struct JpegDecoder {
  jpeg_decompress_struct jpeg{};
  jpeg_error_mgr errors{};
  std::jmp_buf given_up{};

  JpegDecoder() {
    jpeg.err = jpeg_std_error(&errors);
    jpeg.client_data = this;
    // Messages are OpenImageIO's, which is given the file next, also if this is only a warning.
    errors.error_exit = give_up;
    errors.emit_message = [](j_common_ptr state, int level) {
      if (level < 0) give_up(state);
    };
    if (setjmp(given_up)) throw std::bad_alloc();
    jpeg_create_decompress(&jpeg);
  }
  ~JpegDecoder() { jpeg_destroy_decompress(&jpeg); }
  JpegDecoder(const JpegDecoder&) = delete;
  JpegDecoder& operator=(const JpegDecoder&) = delete;

 private:
  [[noreturn]] static void give_up(j_common_ptr state) {
    std::longjmp(static_cast<JpegDecoder*>(state->client_data)->given_up, 1);
  }
};

// libjpeg leaves these two, and the constructor, by longjmp(): nothing in them has a destructor.

bool read_header(JpegDecoder& d, const std::vector<uint8_t>& bytes) {
  if (setjmp(d.given_up)) return false;
  jpeg_mem_src(&d.jpeg, bytes.data(), static_cast<unsigned long>(bytes.size()));
  jpeg_read_header(&d.jpeg, TRUE);
  return true;
}

bool read_rows(JpegDecoder& d, uint8_t* pixels, size_t row_bytes) {
  if (setjmp(d.given_up)) return false;
  jpeg_start_decompress(&d.jpeg);
  while (d.jpeg.output_scanline < d.jpeg.output_height) {
    JSAMPROW row = pixels + row_bytes * d.jpeg.output_scanline;
    jpeg_read_scanlines(&d.jpeg, &row, 1);
  }
  jpeg_finish_decompress(&d.jpeg);
  return true;
}

}  // namespace

std::optional<ImageFile> read_plain_jpeg(const std::vector<uint8_t>& bytes) {
  JpegDecoder decoder;
  if (!read_header(decoder, bytes)) return std::nullopt;
  const jpeg_decompress_struct& jpeg = decoder.jpeg;
  const bool grey = jpeg.jpeg_color_space == JCS_GRAYSCALE && jpeg.num_components == 1;
  const bool coloured = jpeg.num_components == 3 && jpeg.out_color_space == JCS_RGB;
  if (!grey && !coloured) return std::nullopt;
  const size_t width = jpeg.image_width, height = jpeg.image_height,
               channels = size_t(jpeg.num_components), row_bytes = width * channels;
  if (!is_readable_size(width, height, row_bytes * height, bytes.size())) return std::nullopt;

  ImageFile file = unnamed_image(int(width), int(height), int(channels));
  file.display_encoded = true;
  file.bytes.resize(row_bytes * height);
  if (!read_rows(decoder, file.bytes.data(), row_bytes)) return std::nullopt;
  return file;
}

}  // namespace duet
