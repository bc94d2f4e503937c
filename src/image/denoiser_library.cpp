#include "image/denoiser_library.h"

#include <dlfcn.h>
#include <elf.h>
#include <fmt/format.h>

#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

#include "image/module_paths.h"

namespace duet {

namespace fs = std::filesystem;

namespace {

constexpr const char* kLibraryNames[] = {"libOpenImageDenoise.so.2", "libOpenImageDenoise.so"};

/// Whether a library ends before the table that its header says is at its end: the loader would
/// read beyond the end, which kills the program.
bool is_cut_off(const fs::path& path) {
  std::error_code error;
  const uintmax_t size = fs::file_size(path, error);
  Elf64_Ehdr header{};
  std::ifstream file(path, std::ios::binary);
  if (error || !file.read(reinterpret_cast<char*>(&header), sizeof(header))) return false;
  if (std::memcmp(header.e_ident, ELFMAG, SELFMAG) != 0) return false;
  const uintmax_t table = uintmax_t(header.e_shnum) * header.e_shentsize;
  return header.e_shoff > size || table > size - header.e_shoff;
}

[[noreturn]] void fail_to_load(const std::string& why) {
  throw std::runtime_error("Open Image Denoise cannot be loaded: " + why);
}

void* open_denoiser(const fs::path& path) {
  if (path.has_parent_path() && is_cut_off(path)) fail_to_load(path.string() + " has been cut off");
  return dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
}

/// The library's handle; `path` becomes the name that it was found by.
void* find_denoiser(std::string& path) {
  std::string tried;
  const auto open = [&](const fs::path& candidate) {
    void* const library = open_denoiser(candidate);
    if (!library) fail_to_load(dlerror());
    path = candidate.string();
    return library;
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
    if (void* const library = open_denoiser(name)) return library;
    tried += fmt::format("\n  {} ({})", name, dlerror());
  }
  fail_to_load(
      fmt::format("it was not found (set {} to the path of libOpenImageDenoise.so); tried{}",
                  kDenoiserVariable, tried));
}

OidnFunctions load_functions() {
  std::string path;
  void* const library = find_denoiser(path);
  OidnFunctions f;
  const auto get = [&]<class F>(F& function, const char* name) {
    function = reinterpret_cast<F>(dlsym(library, name));
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
