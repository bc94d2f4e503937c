#include <csetjmp>
// jpeglib.h needs these before it.
#include <cstddef>
#include <cstdio>

#include <jpeglib.h>

#include <cstdlib>
#include <stdexcept>

#include "image/display_writers.h"

namespace duet {

namespace {

constexpr int kQuality = 95;

/// libjpeg's state for one file, and what it has written.
struct JpegEncoder {
  jpeg_compress_struct jpeg{};
  jpeg_error_mgr errors{};
  std::jmp_buf stopped{};
  char failure[JMSG_LENGTH_MAX] = "";
  uint8_t* bytes = nullptr;
  unsigned long size = 0;

  JpegEncoder() {
    jpeg.err = jpeg_std_error(&errors);
    jpeg.client_data = this;
    errors.error_exit = stop_encoding;
  }
  ~JpegEncoder() {
    jpeg_destroy_compress(&jpeg);
    std::free(bytes);
  }
  JpegEncoder(const JpegEncoder&) = delete;
  JpegEncoder& operator=(const JpegEncoder&) = delete;

 private:
  [[noreturn]] static void stop_encoding(j_common_ptr state) {
    auto& encoder = *static_cast<JpegEncoder*>(state->client_data);
    state->err->format_message(state, encoder.failure);
    std::longjmp(encoder.stopped, 1);
  }
};

void set_format(jpeg_compress_struct& jpeg, const DisplayPixels& pixels) {
  jpeg.image_width = JDIMENSION(pixels.width);
  jpeg.image_height = JDIMENSION(pixels.height);
  jpeg.input_components = pixels.channels;
  jpeg.in_color_space = pixels.channels == 1 ? JCS_GRAYSCALE : JCS_RGB;
  jpeg_set_defaults(&jpeg);
  jpeg_set_quality(&jpeg, kQuality, TRUE);
  for (int c = 0; c < jpeg.num_components; ++c)
    jpeg.comp_info[c].h_samp_factor = jpeg.comp_info[c].v_samp_factor = 1;
}

/// False if libjpeg fails. It leaves this by longjmp() then: nothing here has a destructor.
bool write_jpeg(JpegEncoder& encoder, const DisplayPixels& pixels) {
  jpeg_compress_struct& jpeg = encoder.jpeg;
  if (setjmp(encoder.stopped)) return false;
  jpeg_create_compress(&jpeg);
  jpeg_mem_dest(&jpeg, &encoder.bytes, &encoder.size);
  set_format(jpeg, pixels);
  jpeg_start_compress(&jpeg, TRUE);
  for (int y = 0; y < pixels.height; ++y) {
    JSAMPROW row = const_cast<JSAMPROW>(pixels.row(size_t(y)));  // it is only read
    jpeg_write_scanlines(&jpeg, &row, 1);
  }
  jpeg_finish_compress(&jpeg);
  return true;
}

}  // namespace

std::vector<uint8_t> encode_jpeg(const DisplayPixels& pixels) {
  JpegEncoder encoder;
  if (!write_jpeg(encoder, pixels)) throw std::runtime_error(encoder.failure);
  return {encoder.bytes, encoder.bytes + encoder.size};
}

}  // namespace duet
