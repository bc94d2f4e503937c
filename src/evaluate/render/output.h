// Where images go and in which form.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "evaluate/report/image_file.h"

namespace duet {

/// Of a raw film in a directory.
inline constexpr const char* kRawExtension = ".raw.exr";

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

/// The same of a path in which all is filled in.
std::string image_path(std::string path, const OutputNames& names, const std::string& extension);

/// Throws UsageError if files cannot hold what an image has: formats for display no image without
/// colours, and they alone no further layers; EXR files no two channels of one name.
void check_formats(const std::vector<std::string>& paths, const std::vector<std::string>& channels,
                   const FileSettings& settings);

/// What users ask for of files that are not written: sentences with the option before a colon.
std::vector<std::string> settings_without_effect(const std::vector<std::string>& paths,
                                                 const FileSettings& settings);

/// Makes a directory and those above it. Whether it is there now; the current one has an empty
/// name.
bool make_directories(const std::filesystem::path& directory, std::error_code& error);

/// Makes the directories in which a file is to be created or replaced. Empty, or for people why it
/// could not be: "cannot write folder/image.exr: it is a directory".
std::string prepare_file(const std::string& path);

/// Writes an image (image_file_bytes()) into directories that are made if they are missing. If that
/// fails the image is saved as EXR in the temporary directory instead. Throws std::runtime_error
/// with both facts.
void write_image(const std::string& path, const Image& image, const ImageForm& form,
                 const HeaderFields& header, const FileSettings& settings);

}  // namespace duet
