// Fingerprints of files and settings: equal for equal things, different for different ones.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace duet {

/// A 64-bit hash of a sequence of texts and files, against mistakes, not against attacks.
class Fingerprint {
 public:
  void add(std::string_view text);
  /// The file's bytes, whatever its name; one that cannot be read counts as such.
  void add_file(const std::string& path);
  void add(const Fingerprint& other) { add_word(other.hash_); }
  /// 16 hexadecimal digits.
  std::string text() const;

 private:
  void add_word(uint64_t word);
  void add_bytes(std::string_view bytes);
  uint64_t hash_ = 0;
};

}  // namespace duet
