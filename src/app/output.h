// Where images go and in which form.
#pragma once

#include <string>
#include <vector>

#include "image/image_io.h"
#include "scene/description.h"

namespace duet {

/// What the placeholders of a path template stand for.
struct OutputNames {
  std::string scene;  ///< the scene file's name without directory and extension
  std::string integrator;
  int spp = 0;
  uint64_t seed = 0;
};

/// Makes the path of an image: fills in {scene} {integrator} {spp} {seed}, appends SCENE.exr to a
/// directory, and stands for SCENE.exr in the current directory if `pattern` is empty. Throws
/// UsageError for unknown placeholders and extensions other than exr, png, jpg and jpeg.
std::string output_path(const std::string& pattern, const OutputNames& names);

/// Whether all scenes of a call would be written to the same file.
bool is_fixed_file(const std::string& pattern);

/// Empty, or why a file could not be created there.
std::string unwritable_reason(const std::string& path);

/// The image with its colours in the channels that the film asks for; further layers are kept.
Image in_pixel_format(const Image& image, PixelFormat format);

/// How display formats show radiance.
struct DisplayOptions {
  double exposure = 0;  ///< stops, on top of what the scene's film says
  std::optional<ToneMapping> tone_mapping;
};

/// Writes the image in the format of the path's extension. If that fails the image is saved in the
/// temporary directory instead. Throws std::runtime_error with both facts.
void write_image(const std::string& path, const Image& image, const ExrOptions& exr,
                 const DisplayOptions& display);

/// Display values of the colours of an image, 8 bits each, with alpha if `with_alpha`.
std::vector<uint8_t> to_display(const Image& image, const DisplayOptions& options, bool with_alpha);

}  // namespace duet
