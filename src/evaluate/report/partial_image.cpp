#include "evaluate/report/partial_image.h"

#include <filesystem>

#include "base/diagnostics.h"
#include "image/image_facts.h"

namespace duet {

namespace fs = std::filesystem;

std::string partial_path(const std::string& path) {
  const std::string extension = fs::path(path).extension().string();
  return path.substr(0, path.size() - extension.size()) + ".partial" + extension;
}

std::string unfinished_reason(const std::string& path, const std::string& settings_hash) {
  std::error_code error;
  if (fs::file_size(path, error) == 0 && !error) return "it is empty";
  try {
    const ImageFacts facts = read_image_facts(path);
    if (!facts.is_complete) return "it has been cut off";
    if (!facts.field("interrupted").empty()) return "its render was interrupted";
    const std::string hash = facts.field("settingsHash");
    if (hash.empty()) return "it does not say how it was made";
    return hash == settings_hash ? "" : "it was made with other settings";
  } catch (const ReadError&) {
    return "it cannot be read";
  }
}

void remove_partial(const std::string& path, const std::string& scene) {
  const std::string partial = partial_path(path);
  std::error_code ignored;
  if (!fs::is_regular_file(partial, ignored)) return;
  try {
    const ImageFacts facts = read_image_facts(partial);
    if (facts.field("interrupted").empty() || facts.field("scene") != scene) return;
  } catch (const ReadError&) {
    return;
  }
  fs::remove(partial, ignored);
}

}  // namespace duet
