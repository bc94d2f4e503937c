// An image in the form in which its film asks for it: pixel formats of files, and what a display
// shows.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "image/image_io.h"
#include "image/tone_curve.h"
#include "scene/description.h"

namespace duet {

/// Whether files of this format have alpha, and whether they have luminance instead of colours.
bool has_alpha(PixelFormat format);
bool is_grey(PixelFormat format);

/// The image with its colours (R, G, B, A) in the channels that the film asks for; further layers
/// are kept. An image without colours stays as it is.
Image in_pixel_format(const Image& image, PixelFormat format);

/// How display formats show radiance.
struct DisplayOptions {
  DisplaySettings settings;
  std::optional<ToneMapping> tone_mapping;  ///< of the film
  TextFields fields = {};                   ///< what the file says about the image
};

/// Values for a display, from 0 to the greatest of the type, channels interleaved.
template <class Value>
struct DisplayImage {
  int channels = 3;  ///< grey, grey and alpha, colours, colours and alpha
  std::vector<Value> values;
};

/// Display values, uint8_t or uint16_t, of the colours of an image with channels R, G, B, A first;
/// alpha, which is multiplied into these colours, is divided out.
template <class Value>
DisplayImage<Value> to_display(const Image& image, const DisplayOptions& options, bool grey,
                               bool with_alpha);

}  // namespace duet
