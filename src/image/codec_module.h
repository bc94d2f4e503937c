// The plain C interface of the separate library duet_oiio.so, which alone is linked with
// OpenImageIO. See docs/decisions/0001-image-codecs-on-demand.md.
#pragma once

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/// Changes whenever anything below does.
#define DUET_CODEC_VERSION 4
#define DUET_CODEC_SYMBOL "duet_codecs"

/// An image handed out by the module. `pixels` are uint8_t or float, rows from the top, channels
/// interleaved; to be given back to `release`.
struct DuetDecodedImage {
  int width, height, channels;
  int is_float;    ///< the pixels are floats; otherwise bytes
  int is_integer;  ///< the file stores integers
  void* pixels;
};

/// `decode` returns 0 and fills `error` (zero-terminated) if it fails. `kind` is OpenImageIO's name
/// of a format: png, jpeg, bmp, targa, hdr, tiff, pnm.
struct DuetCodecs {
  int version;
  int (*decode)(const char* kind, const uint8_t* bytes, size_t size, struct DuetDecodedImage* image,
                char* error, size_t error_size);
  void (*release)(void* memory);
};

/// The module's one symbol.
const struct DuetCodecs* duet_codecs(void);

#ifdef __cplusplus
}
#endif
