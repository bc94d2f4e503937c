#include "evaluate/report/fingerprint.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <vector>

#include "base/system/files.h"
#include "math/hash.h"

namespace duet {

void Fingerprint::add_word(uint64_t word) {
  hash_ = hash_combine(hash_, word);
}

void Fingerprint::add_bytes(std::string_view bytes) {
  for (; !bytes.empty(); bytes.remove_prefix(std::min(bytes.size(), sizeof(uint64_t)))) {
    uint64_t word = 0;
    std::memcpy(&word, bytes.data(), std::min(bytes.size(), sizeof word));
    add_word(word);
  }
}

void Fingerprint::add(std::string_view text) {
  add_bytes(text);
  add_word(text.size());
}

void Fingerprint::add_file(const std::string& path) {
  std::error_code ignored;
  // A pipe would wait forever.
  const bool is_file = std::filesystem::is_regular_file(path, ignored);
  const FileStream file = is_file ? open_for_reading(path) : nullptr;
  uint64_t size = 0;
  if (!file) return add_word(~size);
  std::vector<char> block(1 << 20);
  while (const size_t n = std::fread(block.data(), 1, block.size(), file.get())) {
    add_bytes({block.data(), n});
    size += n;
  }
  add_word(size);
}

std::string Fingerprint::text() const {
  return fmt::format("{:016x}", hash_);
}

}  // namespace duet
