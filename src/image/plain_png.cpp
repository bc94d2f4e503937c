#include "image/plain_png.h"

#include <png.h>

#include <csetjmp>
#include <cstring>
#include <new>

#include "image/image_limits.h"

namespace duet {

namespace {

/// What is left of the file.
struct Source {
  const uint8_t* at;
  size_t left;
};

void take_bytes(png_structp png, png_bytep to, size_t count) {
  auto& source = *static_cast<Source*>(png_get_io_ptr(png));
  if (count > source.left) png_error(png, "the file is cut");
  std::memcpy(to, source.at, count);
  source.at += count;
  source.left -= count;
}

// Messages are OpenImageIO's, which is given the file next.
[[noreturn]] void give_up(png_structp png, png_const_charp) {
  png_longjmp(png, 1);
}
void ignore(png_structp, png_const_charp) {}

/// libpng's state for one file.
struct Decoder {
  png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, nullptr, give_up, ignore);
  png_infop info = png ? png_create_info_struct(png) : nullptr;

  Decoder() {
    if (!info) throw std::bad_alloc();
  }
  ~Decoder() { png_destroy_read_struct(&png, &info, nullptr); }
  Decoder(const Decoder&) = delete;
  Decoder& operator=(const Decoder&) = delete;
};

// libpng leaves these two by longjmp() where a file is damaged: nothing in them has a destructor.

bool read_header(const Decoder& d, Source& source) {
  if (setjmp(png_jmpbuf(d.png))) return false;
  png_set_read_fn(d.png, &source, take_bytes);
  png_read_info(d.png, d.info);
  return true;
}

/// All rows, and what follows them.
bool read_rows(const Decoder& d, uint8_t** rows) {
  if (setjmp(png_jmpbuf(d.png))) return false;
  png_read_image(d.png, rows);
  png_read_end(d.png, nullptr);
  return true;
}

bool is_plain(const Decoder& d) {
  return png_get_bit_depth(d.png, d.info) == 8 &&
         png_get_color_type(d.png, d.info) != PNG_COLOR_TYPE_PALETTE &&
         png_get_interlace_type(d.png, d.info) == PNG_INTERLACE_NONE &&
         !png_get_valid(d.png, d.info, PNG_INFO_tRNS);
}

}  // namespace

std::optional<ImageFile> read_plain_png(const std::vector<uint8_t>& bytes) {
  Decoder decoder;
  Source source{bytes.data(), bytes.size()};
  if (!read_header(decoder, source) || !is_plain(decoder)) return std::nullopt;
  const size_t width = png_get_image_width(decoder.png, decoder.info),
               height = png_get_image_height(decoder.png, decoder.info),
               channels = png_get_channels(decoder.png, decoder.info), row_bytes = width * channels;
  if (!is_readable_size(width, height, (row_bytes + 1) * height, bytes.size())) return std::nullopt;

  ImageFile file = unnamed_image(int(width), int(height), int(channels));
  file.display_encoded = true;
  file.bytes.resize(row_bytes * height);
  std::vector<uint8_t*> rows(height);
  for (size_t y = 0; y < height; ++y) rows[y] = &file.bytes[y * row_bytes];
  if (!read_rows(decoder, rows.data())) return std::nullopt;
  return file;
}

}  // namespace duet
