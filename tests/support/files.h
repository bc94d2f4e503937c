// Files that tests make at run time, and bytes to put into them.
#pragma once

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace duet::test {

/// A directory that goes away with everything in it.
class TemporaryDirectory {
 public:
  TemporaryDirectory();
  ~TemporaryDirectory();
  TemporaryDirectory(const TemporaryDirectory&) = delete;
  TemporaryDirectory& operator=(const TemporaryDirectory&) = delete;

  std::string path(const std::string& name) const;
  /// Writes a file and returns its path.
  std::string write(const std::string& name, std::string_view contents) const;
  /// The number of files and directories within.
  size_t count() const;

 private:
  std::filesystem::path path_;
};

std::string read_file(const std::string& path);

/// The bytes of a text, which must outlive them.
inline std::span<const uint8_t> bytes_of(std::string_view text) {
  return {reinterpret_cast<const uint8_t*>(text.data()), text.size()};
}

/// The bytes of numbers, in the machine's order or turned around.
template <class... T>
std::string pack(T... values) {
  std::string result;
  const auto add = [&](const auto& v) {
    result.append(reinterpret_cast<const char*>(&v), sizeof(v));
  };
  (add(values), ...);
  return result;
}
template <class... T>
std::string pack_swapped(T... values) {
  std::string result;
  const auto add = [&](const auto& v) {
    const std::string bytes = pack(v);
    result.append(bytes.rbegin(), bytes.rend());
  };
  (add(values), ...);
  return result;
}

}  // namespace duet::test
