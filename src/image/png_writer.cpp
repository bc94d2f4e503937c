#include <png.h>

#include <bit>
#include <csetjmp>
#include <cstdio>
#include <new>
#include <stdexcept>

#include "image/display_writers.h"

namespace duet {

namespace {

/// libpng's state for one file, and what it has written.
struct PngEncoder {
  std::vector<uint8_t> bytes;
  char failure[256] = "";
  png_structp png =
      png_create_write_struct(PNG_LIBPNG_VER_STRING, this, stop_encoding, ignore_warning);
  png_infop info = png ? png_create_info_struct(png) : nullptr;

  PngEncoder() {
    if (!info) throw std::bad_alloc();
  }
  ~PngEncoder() { png_destroy_write_struct(&png, &info); }
  PngEncoder(const PngEncoder&) = delete;
  PngEncoder& operator=(const PngEncoder&) = delete;

 private:
  [[noreturn]] static void stop_encoding(png_structp png, png_const_charp reason) {
    auto& encoder = *static_cast<PngEncoder*>(png_get_error_ptr(png));
    std::snprintf(encoder.failure, sizeof(encoder.failure), "%s", reason);
    png_longjmp(png, 1);
  }
  static void ignore_warning(png_structp, png_const_charp) {}
};

void append(png_structp png, png_bytep data, size_t count) {
  auto& bytes = static_cast<PngEncoder*>(png_get_io_ptr(png))->bytes;
  bool appended = true;
  try {
    bytes.insert(bytes.end(), data, data + count);
  } catch (const std::bad_alloc&) {
    appended = false;  // no exception may pass through libpng
  }
  if (!appended) png_error(png, "it is too large for the memory");
}

constexpr int colour_type(int channels) {
  constexpr int kTypes[] = {PNG_COLOR_TYPE_GRAY, PNG_COLOR_TYPE_GRAY_ALPHA, PNG_COLOR_TYPE_RGB,
                            PNG_COLOR_TYPE_RGB_ALPHA};
  return kTypes[channels - 1];
}

/// False if libpng fails. It leaves this by longjmp() then: nothing here has a destructor.
bool write_png(PngEncoder& encoder, const DisplayPixels& pixels) {
  const png_structp png = encoder.png;
  if (setjmp(png_jmpbuf(png))) return false;
  png_set_write_fn(png, &encoder, append, nullptr);
  png_set_user_limits(png, PNG_UINT_31_MAX, PNG_UINT_31_MAX);
  png_set_IHDR(png, encoder.info, png_uint_32(pixels.width), png_uint_32(pixels.height),
               pixels.bits, colour_type(pixels.channels), PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_set_sRGB_gAMA_and_cHRM(png, encoder.info, PNG_sRGB_INTENT_PERCEPTUAL);
  png_write_info(png, encoder.info);
  if (std::endian::native == std::endian::little) png_set_swap(png);
  for (int y = 0; y < pixels.height; ++y) png_write_row(png, pixels.row(size_t(y)));
  png_write_end(png, nullptr);
  return true;
}

}  // namespace

std::vector<uint8_t> encode_png(const DisplayPixels& pixels) {
  PngEncoder encoder;
  if (!write_png(encoder, pixels)) throw std::runtime_error(encoder.failure);
  return std::move(encoder.bytes);
}

}  // namespace duet
