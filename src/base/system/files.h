// Files and folders, as far as std::filesystem and std::fopen() do not do.
#pragma once

#include <cstdint>
#include <cstdio>
#include <memory>
#include <string>
#include <system_error>
#include <vector>

namespace duet {

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
/// Closes a file when it goes away.
using FileStream = std::unique_ptr<std::FILE, CloseFile>;

/// Open files that other programs, which are started meanwhile, do not get. Null if that fails, and
/// errno says why.
FileStream open_for_reading(const std::string& path);
/// A file that is there loses what it holds. A pipe that nobody reads is ENXIO.
FileStream open_for_writing(const std::string& path);

/// A regular file, open for reading.
class InputFile {
 public:
  /// Throws ReadError if it cannot be opened or is not a regular file.
  explicit InputFile(const std::string& path);
  std::FILE* stream() const { return stream_.get(); }
  /// Bytes that it had when it was opened.
  uint64_t size() const { return size_; }
  /// Continues at a position. If that fails, it is false, and errno says why.
  bool seek(uint64_t position) const;

 private:
  FileStream stream_;
  uint64_t size_ = 0;
};

/// Whether this process may write to a file, or make files in a folder.
bool is_writable(const std::string& path);

/// Makes a folder, which nobody else may read, whose path is `beginning` and some more characters.
/// Returns the path, of the last attempt if there was an error.
std::string make_temporary_folder(const std::string& beginning, std::error_code& error);

/// The files whose paths a pattern with *, ? and [] matches, as shells have them; in order.
std::vector<std::string> files_of_pattern(const std::string& pattern);

}  // namespace duet
