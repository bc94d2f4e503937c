// Libraries that are loaded while the program runs.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace duet {

/// A library that has been loaded into this process, and stays there until its end.
class SharedLibrary {
 public:
  /// Nothing if the file cannot be loaded, and `failure` is the reason then. A name without a
  /// folder is looked for where the system has its libraries.
  static std::optional<SharedLibrary> load(const std::filesystem::path& file, std::string& failure);

  /// The function of this name; null if it has none.
  template <class Function>
  Function function(const char* name) const {
    return reinterpret_cast<Function>(address(name));
  }

 private:
  explicit SharedLibrary(void* handle) : handle_(handle) {}
  void* address(const char* name) const;

  void* handle_;
};

/// Whether a library ends before the table that its header says is at its end: the loader would
/// read beyond the end, which kills the program.
bool is_cut_off(const std::filesystem::path& file);

/// The program or library that this code is in, or "" if that cannot be found out.
std::string own_library();

}  // namespace duet
