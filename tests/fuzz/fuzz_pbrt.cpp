// Feeds arbitrary bytes to the reader of pbrt's scenes as scene.pbrt and, after zero bytes, a.pbrt,
// b.pbrt, … that it may include. What is read must be one that can be written and read again.
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "pbrt/pbrt.h"
#include "pbrt/writer.h"

namespace {

using namespace duet;

namespace fs = std::filesystem;

/// The folder of this process, in memory where there is such a place.
const fs::path& folder() {
  static const fs::path path = [] {
    const fs::path memory = "/dev/shm";
    fs::path made = (fs::is_directory(memory) ? memory : fs::temp_directory_path()) /
                    ("duet-fuzz-" + std::to_string(getpid()));
    fs::create_directories(made);
    return made;
  }();
  return path;
}

void write(const std::string& name, const std::string& text) {
  std::ofstream(folder() / name, std::ios::binary) << text;
}

void write_inputs(const uint8_t* data, size_t size) {
  for (const char* included : {"a.pbrt", "b.pbrt", "c.pbrt"}) fs::remove(folder() / included);
  std::string name = "scene.pbrt", text;
  char next = 'a';
  for (size_t i = 0; i < size; ++i)
    if (data[i] != 0 || next > 'c') {
      text += char(data[i]);
    } else {
      write(name, text);
      name = std::string(1, next++) + ".pbrt";
      text.clear();
    }
  write(name, text);
}

void require(bool condition) {
  if (!condition) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  write_inputs(data, size);
  pbrt::Options options;
  // Nothing outside of the folder is read.
  options.exists = [](const std::string& path) {
    return fs::path(path).parent_path() == folder() && fs::exists(path);
  };
  Diagnostics diagnostics;
  const auto scene = pbrt::read_pbrt((folder() / "scene.pbrt").string(), options, diagnostics);
  // Either a scene or the reason why not.
  require(scene.has_value() == (diagnostics.error_count() == 0));
  for (const Diagnostic& d : diagnostics.all()) require(!d.to_string().empty());
  if (!scene) return 0;

  const pbrt::PbrtText written = pbrt::write_pbrt(scene->description);
  write("scene.pbrt", written.text);
  Diagnostics messages;
  const auto copy = pbrt::read_pbrt((folder() / "scene.pbrt").string(), options, messages);
  require(copy || !written.losses.empty());
  return 0;
}
