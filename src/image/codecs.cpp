#include "image/codecs.h"

#include <cstdlib>
#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>

#include "base/parallel.h"
#include "base/system/shared_library.h"
#include "image/module_paths.h"

namespace duet {

namespace fs = std::filesystem;

namespace {

constexpr const char* kModule = "duet_oiio.so";

/// Where the module may be: where the user says, or in one of the directories for modules.
std::vector<fs::path> candidates() {
  if (const char* chosen = std::getenv(kImageModuleVariable)) return {chosen};
  std::vector<fs::path> paths = module_directories();
  for (fs::path& path : paths) path /= kModule;
  return paths;
}

const DuetCodecs* load() {
  std::string tried;
  for (const fs::path& path : candidates()) {
    std::error_code error;
    if (!fs::exists(path, error)) {
      tried += "\n  " + path.string();
      continue;
    }
    // Libraries that it is linked with start threads while it is loaded, and end the program if
    // they cannot.
    constexpr int kThreads = 6;
    if (startable_threads(kThreads) < kThreads)
      throw std::runtime_error(
          "the library for image formats needs threads, and the system lets this process have no "
          "more");
    std::string failure;
    const std::optional<SharedLibrary> library = SharedLibrary::load(path, failure);
    if (!library)
      throw std::runtime_error(
          fmt::format("the library for image formats cannot be loaded: {}", failure));
    const auto get = library->function<const DuetCodecs* (*)()>(DUET_CODEC_SYMBOL);
    if (!get || get()->version != DUET_CODEC_VERSION)
      throw std::runtime_error(
          fmt::format("the library for image formats, {}, is of another version", path.string()));
    return get();
  }
  throw std::runtime_error(fmt::format(
      "this image format needs the library {}, which was not found (set {} to its path); tried{}",
      kModule, kImageModuleVariable, tried));
}

const DuetCodecs& codecs() {
  // A library is loaded once for the whole process, and never changes then. Tried again if it
  // failed.
  static const DuetCodecs* const loaded = load();
  return *loaded;
}

struct Release {
  void operator()(void* p) const { codecs().release(p); }
};

}  // namespace

ImageFile decode_with_module(const char* kind, const std::vector<uint8_t>& bytes) {
  DuetDecodedImage decoded{};
  char error[1024] = "";
  if (!codecs().decode(kind, bytes.data(), bytes.size(), &decoded, error, sizeof(error)))
    throw std::runtime_error(error);
  const std::unique_ptr<void, Release> pixels(decoded.pixels);

  ImageFile file = unnamed_image(decoded.width, decoded.height, decoded.channels);
  file.display_encoded = decoded.is_integer;
  const size_t count = size_t(decoded.width) * size_t(decoded.height) * size_t(decoded.channels);
  if (decoded.is_float) {
    const float* p = static_cast<const float*>(pixels.get());
    file.image.data.assign(p, p + count);
  } else {
    const uint8_t* p = static_cast<const uint8_t*>(pixels.get());
    file.bytes.assign(p, p + count);
  }
  return file;
}

}  // namespace duet
