// Where images go and in which form.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "scene/film_image.h"

namespace duet {

/// What the placeholders of a path template stand for.
struct OutputNames {
  /// The scene file's name without directory and extension; of a scene.xml, whose name says
  /// nothing, the name of the directory.
  std::string scene;
  std::string folder;  ///< the name of the directory it lies in
  std::string integrator, spp, seed;
};

/// The names that follow from the scene file's path alone; kStandardInput is called "stdin".
OutputNames output_names(const std::string& scene_file);

/// Makes the path of an image: fills in {scene} {folder} {integrator} {spp} {seed}, appends SCENE
/// and `extension` to a directory, and stands for SCENE in the current directory if `pattern` is
/// empty. "-" becomes kStandardOutput. Throws UsageError for unknown placeholders and extensions
/// other than exr, png, jpg, jpeg.
std::string output_path(const std::string& pattern, const OutputNames& names,
                        const std::string& extension = ".exr");

/// Whether the path's extension is that of a format for display: png, jpg or jpeg.
bool is_display_format(const std::string& path);
/// Throws UsageError if an image without colours is to be written in a format for display.
void check_has_colours(const std::string& path, const std::vector<std::string>& channels);
/// The format that images of such a name are written in: "exr", "png", "jpg" or, for all others,
/// "".
std::string image_format(const std::string& path);

/// Makes a directory and those above it. Whether it is there now; the current one has an empty
/// name.
bool make_directories(const std::filesystem::path& directory, std::error_code& error);

/// Makes the directories in which a file is to be created or replaced. Empty, or why it could not
/// be.
std::string prepare_file(const std::string& path);

/// Writes the image (channels R, G, B, A first, if it has colours) in the format of the path's
/// extension, into directories that are made if they are missing. If that fails the image is saved
/// as EXR in the temporary directory instead. Throws std::runtime_error with both facts.
void write_image(const std::string& path, const Image& image, PixelFormat format,
                 const ExrOptions& exr, const DisplayOptions& display);

}  // namespace duet
