#include "image/denoiser_library.h"

#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>

#include "base/system/shared_library.h"
#include "image/module_paths.h"

namespace duet {

namespace fs = std::filesystem;

namespace {

constexpr const char* kLibraryNames[] = {"libOpenImageDenoise.so.2", "libOpenImageDenoise.so"};

[[noreturn]] void fail_to_load(const std::string& why) {
  throw std::runtime_error("Open Image Denoise cannot be loaded: " + why);
}

std::optional<SharedLibrary> open_denoiser(const fs::path& path, std::string& failure) {
  if (path.has_parent_path() && is_cut_off(path)) fail_to_load(path.string() + " has been cut off");
  return SharedLibrary::load(path, failure);
}

/// The library; `path` becomes the name that it was found by.
SharedLibrary find_denoiser(std::string& path) {
  std::string tried, failure;
  const auto open = [&](const fs::path& candidate) {
    const std::optional<SharedLibrary> library = open_denoiser(candidate, failure);
    if (!library) fail_to_load(failure);
    path = candidate.string();
    return *library;
  };
  if (const char* chosen = std::getenv(kDenoiserVariable)) {
    // A name without a slash would be looked for elsewhere.
    std::error_code error;
    const fs::path file = fs::absolute(chosen, error);
    if (!fs::exists(file, error))
      fail_to_load(fmt::format("{} ({}) does not exist", chosen, kDenoiserVariable));
    return open(file);
  }
  for (const fs::path& directory : module_directories())
    for (const char* name : kLibraryNames) {
      std::error_code error;
      if (fs::exists(directory / name, error)) return open(directory / name);
      tried += "\n  " + (directory / name).string();
    }
  for (const char* name : kLibraryNames) {
    path = name;
    if (const auto library = open_denoiser(name, failure)) return *library;
    tried += fmt::format("\n  {} ({})", name, failure);
  }
  fail_to_load(
      fmt::format("it was not found (set {} to the path of libOpenImageDenoise.so); tried{}",
                  kDenoiserVariable, tried));
}

OidnFunctions load_functions() {
  std::string path;
  const SharedLibrary library = find_denoiser(path);
  OidnFunctions f;
  const auto get = [&]<class F>(F& function, const char* name) {
    function = library.function<F>(name);
    if (!function)
      fail_to_load(fmt::format("{} is not its version 2: it has no function {}", path, name));
  };
  get(f.new_device, "oidnNewDevice");
  get(f.set_device_int, "oidnSetDeviceInt");
  get(f.set_device_bool, "oidnSetDeviceBool");
  get(f.get_device_int, "oidnGetDeviceInt");
  get(f.commit_device, "oidnCommitDevice");
  get(f.get_device_error, "oidnGetDeviceError");
  get(f.release_device, "oidnReleaseDevice");
  get(f.new_filter, "oidnNewFilter");
  get(f.set_filter_image, "oidnSetSharedFilterImage");
  get(f.set_filter_bool, "oidnSetFilterBool");
  get(f.commit_filter, "oidnCommitFilter");
  get(f.execute_filter, "oidnExecuteFilter");
  get(f.release_filter, "oidnReleaseFilter");
  return f;
}

}  // namespace

const OidnFunctions& load_denoiser_library() {
  // A library is loaded once for the whole process. Tried again if it failed.
  static const OidnFunctions functions = load_functions();
  return functions;
}

}  // namespace duet
