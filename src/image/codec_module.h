// The plain C interface of the separate library duet_oiio.so, which alone is linked with
// OpenImageIO. See docs/decisions/0001-image-codecs-on-demand.md.
#pragma once

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/// Changes whenever anything below does.
#define DUET_CODEC_VERSION 3
#define DUET_CODEC_SYMBOL "duet_codecs"

/// An image handed out by the module. `pixels` are uint8_t or float, rows from the top, channels
/// interleaved; to be given back to `release`.
struct DuetDecodedImage {
  int width, height, channels;
  int is_float;    ///< the pixels are floats; otherwise bytes
  int is_integer;  ///< the file stores integers
  void* pixels;
};

/// An image for the module: integers of 8 or 16 bits, rows from the top, channels interleaved.
struct DuetPixels {
  int width, height, channels;
  int bits;  ///< 8: `values` are uint8_t; 16: uint16_t
  const void* values;
};

/// Bytes handed out by the module, to be given back to `release`.
struct DuetEncodedImage {
  size_t size;
  uint8_t* bytes;
};

/// Functions return 0 and fill `error` (zero-terminated) if they fail. `kind` is OpenImageIO's name
/// of a format: png, jpeg, bmp, targa, hdr, tiff, pnm.
struct DuetCodecs {
  int version;
  int (*decode)(const char* kind, const uint8_t* bytes, size_t size, struct DuetDecodedImage* image,
                char* error, size_t error_size);
  int (*encode)(const char* kind, const struct DuetPixels* pixels, struct DuetEncodedImage* image,
                char* error, size_t error_size);
  void (*release)(void* memory);
};

/// The module's one symbol.
const struct DuetCodecs* duet_codecs(void);

#ifdef __cplusplus
}
#endif
