#include "evaluate/render/output.h"

#include <fmt/format.h>

#include <filesystem>
#include <stdexcept>

#include "base/failures.h"
#include "base/system/atomic_file.h"
#include "base/system/files.h"
#include "base/system/process.h"
#include "base/system/standard_streams.h"
#include "evaluate/render/placeholders.h"
#include "evaluate/render/scene_operand.h"

namespace duet {

namespace fs = std::filesystem;

namespace {

/// So many bytes of an image's name are in the one that it is rescued by, which must not be too
/// long.
constexpr size_t kRescuedStem = 100;

bool is_directory(const std::string& path) {
  std::error_code ignored;
  return path.ends_with('/') || fs::is_directory(path, ignored);
}

/// Why there can be no file of this name, or "".
std::string obstacle_to(const std::string& path) {
  if (is_standard_output(path)) return standard_output_refusal();
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (error == std::errc::filename_too_long) return "its name is too long";
  if (fs::is_directory(status)) return "it is a directory";
  if (fs::exists(status) && !fs::is_regular_file(status)) return "it is not a regular file";
  const fs::path parent = fs::path(path).has_parent_path() ? fs::path(path).parent_path() : ".";
  if (!make_directories(parent, error))
    return fmt::format("the directory \"{}\" cannot be made: {}", parent.string(), error.message());
  if (!is_writable(parent.string()))
    return fmt::format("the directory \"{}\" is not writable", parent.string());
  return "";
}

}  // namespace

OutputNames output_names(const std::string& scene_file) {
  std::error_code ignored;
  const bool is_stdin = scene_file == kStandardInput;
  fs::path path = fs::absolute(is_stdin ? "stdin.xml" : scene_file, ignored).lexically_normal();
  if (!path.has_filename()) path = path.parent_path();  // a directory without a scene
  const std::string folder = path.parent_path().filename().string();
  const bool says_nothing = path.filename() == "scene.xml" && !folder.empty();
  return {says_nothing ? folder : path.stem().string(), folder, "", "", ""};
}

void check_formats(const std::vector<std::string>& paths, const std::vector<std::string>& channels,
                   const FileSettings& settings) {
  const bool keeps_layers = !std::all_of(paths.begin(), paths.end(), is_display_format);
  for (const std::string& path : paths) {
    if (is_display_format(path) && channels[0] != "R")
      throw UsageError(
          fmt::format("-o {}: the image has layers only, which .exr files can hold", path));
    // Colours and alpha come first.
    if (!keeps_layers && channels.size() > 4)
      throw UsageError(
          fmt::format("-o {}: only .exr files can hold the other layers ({}{}); write one, too",
                      path, channels[4], channels.size() > 5 ? ", …" : ""));
  }
  try {
    if (keeps_layers) channels_in(settings.aov_names, channels);
  } catch (const std::invalid_argument& e) {
    throw UsageError(fmt::format("--aov-names: {}", e.what()));
  }
}

std::vector<std::string> settings_without_effect(const std::vector<std::string>& paths,
                                                 const FileSettings& settings) {
  std::vector<std::string> all;
  const auto check = [&](bool is_asked_for, const char* option, const char* formats,
                         const auto& shows) {
    if (is_asked_for && std::none_of(paths.begin(), paths.end(), shows))
      all.push_back(fmt::format("{}: there is no {} to be written", option, formats));
  };
  const auto is_png = [](const std::string& path) { return image_format(path) == "png"; };
  const auto is_exr = [](const std::string& path) { return image_format(path) == "exr"; };
  const DisplaySettings& d = settings.display;
  check(d.exposure != 0 || d.automatic, "--exposure", ".png or .jpg", is_display_format);
  check(d.curve.has_value(), "--tonemap", ".png or .jpg", is_display_format);
  check(d.png_depth != 8, "--png-depth", ".png", is_png);
  check(settings.aov_names != AovNames::duet, "--aov-names", ".exr", is_exr);
  check(settings.exr_parts, "--exr-parts", ".exr", is_exr);
  return all;
}

std::string output_path(const std::string& pattern, const OutputNames& names,
                        const std::string& extension) {
  if (pattern == "-") return kStandardOutput + extension;
  return image_path(fill_in("-o", pattern,
                            {{"scene", names.scene},
                             {"folder", names.folder},
                             {"integrator", names.integrator},
                             {"spp", names.spp},
                             {"seed", names.seed}}),
                    names, extension);
}

std::string image_path(std::string path, const OutputNames& names, const std::string& extension) {
  if (path.empty())
    path = names.scene + extension;
  else if (is_directory(path))
    path = (fs::path(path) / (names.scene + extension)).string();
  if (image_format(path).empty())
    throw UsageError(fmt::format(
        "-o {}: images are written as .exr, .png or .jpg; the name of a new directory ends with /",
        path));
  return path;
}

bool make_directories(const fs::path& directory, std::error_code& error) {
  if (directory.empty()) return true;
  // A slash at the end would make it an error that the directory is there.
  fs::create_directories(directory.has_filename() ? directory : directory.parent_path(), error);
  std::error_code ignored;
  return fs::is_directory(directory, ignored);
}

std::string prepare_file(const std::string& path) {
  const std::string why = obstacle_to(path);
  return why.empty() ? "" : fmt::format("cannot write {}: {}", path, why);
}

void write_image(const std::string& path, const Image& image, const ImageForm& form,
                 const HeaderFields& header, const FileSettings& settings) {
  const auto write = [&](const std::string& to) {
    const std::vector<uint8_t> bytes = image_file_bytes(to, image, form, header, settings);
    if (is_standard_output(to)) return write_standard_output(bytes);
    // The number of samples may be part of its name, and is known only now.
    std::error_code ignored;
    make_directories(fs::path(to).parent_path(), ignored);
    write_file_atomically(to, bytes);
  };
  try {
    write(path);
  } catch (const std::exception& failure) {
    std::error_code ignored;
    fs::path folder = fs::temp_directory_path(ignored);
    if (folder.empty()) folder = "/tmp";
    const std::string stem = is_standard_output(path)
                                 ? "stdout"
                                 : fs::path(path).stem().string().substr(0, kRescuedStem);
    std::string rescue;
    // Scenes of one call may have the same name.
    for (int number = 0; rescue.empty() || fs::exists(rescue, ignored); ++number)
      rescue = (folder / fmt::format("duet-{}-{}-{}.exr", stem, process_id(), number)).string();
    std::string outcome;
    try {
      write(rescue);
      outcome = fmt::format("; the image is saved as {}", rescue);
    } catch (const std::exception& second) {
      outcome = fmt::format("; nor could it be saved as {}: {}", rescue, second.what());
    }
    throw std::runtime_error(std::string(failure.what()) + outcome);
  }
}

}  // namespace duet
