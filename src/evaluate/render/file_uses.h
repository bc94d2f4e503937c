// What the files of one call are for: none is written that has another use.
#pragma once

#include <map>
#include <string>

namespace duet {

/// The film that a render goes on from, which its own may replace.
inline constexpr const char* kResume = "--resume";

class FileUses {
 public:
  /// A file that is read; `use` is an option, or what it is to the call: "the scene".
  void read(const std::string& use, const std::string& path);
  /// A file that is written. Throws UsageError if it has another use already, by whatever path,
  /// unless that is `allowed`.
  void write(const std::string& use, const std::string& path, const std::string& allowed = "");

 private:
  struct Use {
    std::string name, path;
  };
  std::map<std::string, Use> uses_;  ///< by the file that a path leads to
};

/// The file that a path leads to, as it is called without links and detours.
std::string file_behind(const std::string& path);

}  // namespace duet
