#include "base/system/shared_library.h"

#include <dlfcn.h>
#include <elf.h>

#include <cstdint>
#include <cstring>
#include <fstream>

namespace duet {

namespace fs = std::filesystem;

std::optional<SharedLibrary> SharedLibrary::load(const fs::path& file, std::string& failure) {
  if (void* const handle = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL))
    return SharedLibrary(handle);
  failure = dlerror();
  return std::nullopt;
}

void* SharedLibrary::address(const char* name) const {
  return dlsym(handle_, name);
}

bool is_cut_off(const fs::path& file) {
  std::error_code error;
  const uintmax_t size = fs::file_size(file, error);
  Elf64_Ehdr header{};
  std::ifstream stream(file, std::ios::binary);
  if (error || !stream.read(reinterpret_cast<char*>(&header), sizeof(header))) return false;
  if (std::memcmp(header.e_ident, ELFMAG, SELFMAG) != 0) return false;
  const uintmax_t table = uintmax_t(header.e_shnum) * header.e_shentsize;
  return header.e_shoff > size || table > size - header.e_shoff;
}

std::string own_library() {
  Dl_info self;
  const bool is_known = dladdr(reinterpret_cast<const void*>(&own_library), &self) != 0;
  return is_known && self.dli_fname ? self.dli_fname : "";
}

}  // namespace duet
