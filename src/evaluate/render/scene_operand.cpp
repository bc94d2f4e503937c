#include "evaluate/render/scene_operand.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <stdexcept>

#include "base/diagnostics.h"
#include "base/failures.h"
#include "base/readable.h"

namespace duet {

namespace fs = std::filesystem;

namespace {

/// Larger texts are not scene descriptions.
constexpr size_t kLargestText = size_t(256) << 20;
/// Of a folder's files, for messages.
constexpr size_t kMostNames = 10000, kMostShown = 5;

bool is_folder(const std::string& path) {
  std::error_code ignored;
  return fs::is_directory(path, ignored);
}

/// The names of the .xml files in a folder, in order.
std::vector<std::string> scene_names(const fs::path& folder) {
  std::vector<std::string> names;
  std::error_code error;
  fs::directory_iterator entry(folder, error), end;
  while (!error && entry != end && names.size() < kMostNames) {
    if (entry->path().extension() == ".xml") names.push_back(entry->path().filename().string());
    entry.increment(error);
  }
  std::sort(names.begin(), names.end());
  return names;
}

std::string no_scene_in_folder(const std::string& folder) {
  std::vector<std::string> names = scene_names(folder);
  if (names.empty()) return "there is no .xml file in this folder";
  const size_t more = names.size() - std::min(names.size(), kMostShown);
  names.resize(names.size() - more);
  return fmt::format("this folder has no scene.xml but {}{}; name one", fmt::join(names, ", "),
                     more > 0 ? fmt::format(" and {} more .xml files", more) : "");
}

/// " (did you mean …?)" for a file that does not exist.
std::string similar_file(const fs::path& file) {
  std::error_code ignored;
  if (fs::exists(file.string() + ".xml", ignored))
    return fmt::format(" (did you mean \"{}.xml\"?)", file.string());
  std::vector<std::string> stems;
  for (const fs::path name : scene_names(file.has_parent_path() ? file.parent_path() : "."))
    stems.push_back(name.stem().string());
  const std::string stem = nearest_name(file.stem().string(), stems);
  if (stem.empty()) return "";
  return fmt::format(" (did you mean \"{}.xml\"?)", (file.parent_path() / stem).string());
}

}  // namespace

std::string scene_file_of(const std::string& operand) {
  if (operand == "-") return kStandardInput;
  if (!is_folder(operand)) return operand;
  const std::vector<std::string> names = scene_names(operand);
  const bool usual = std::find(names.begin(), names.end(), "scene.xml") != names.end();
  if (!usual && names.size() != 1) return operand;
  return (fs::path(operand) / (usual ? "scene.xml" : names[0])).lexically_normal().string();
}

std::string no_scene_reason(const std::string& file, const std::string& standard_input) {
  if (file == kStandardInput) return standard_input.empty() ? "it is empty" : "";
  if (is_folder(file)) return no_scene_in_folder(file);
  const std::string why = unreadable_reason(file);
  std::error_code error;
  if (!why.empty()) return fs::exists(file, error) ? why : why + similar_file(file);
  return fs::file_size(file, error) == 0 && !error ? "it is empty" : "";
}

std::string read_standard_input(const std::vector<std::string>& scene_files) {
  const auto count = std::count(scene_files.begin(), scene_files.end(), kStandardInput);
  if (count > 1) throw UsageError("-: standard input holds one scene");
  std::string text;
  if (count == 0) return text;
  char block[1 << 16];
  while (const size_t n = std::fread(block, 1, sizeof block, stdin)) {
    text.append(block, n);
    if (text.size() > kLargestText)
      throw std::runtime_error(fmt::format("cannot read {}: it is larger than {} MB",
                                           kStandardInput, kLargestText >> 20));
  }
  if (std::ferror(stdin))
    throw std::runtime_error(
        fmt::format("cannot read {}: {}", kStandardInput, std::strerror(errno)));
  return text;
}

}  // namespace duet
