#include "base/system/files.h"

#include <fcntl.h>
#include <glob.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>

#include "base/diagnostics.h"

namespace duet {

FileStream open_for_reading(const std::string& path) {
  // Without blocking: a pipe that nobody writes to would be waited for.
  const int file = open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  if (file < 0) return nullptr;
  FileStream stream(fdopen(file, "rb"));
  if (!stream) close(file);
  return stream;
}

FileStream open_for_writing(const std::string& path) {
  // Without blocking: a pipe that nobody reads would be waited for.
  const int file = open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_NONBLOCK | O_CLOEXEC, 0666);
  if (file < 0) return nullptr;
  // Its reader may be slower than we are.
  fcntl(file, F_SETFL, fcntl(file, F_GETFL) & ~O_NONBLOCK);
  FileStream stream(fdopen(file, "wb"));
  if (!stream) close(file);
  return stream;
}

InputFile::InputFile(const std::string& path) : stream_(open_for_reading(path)) {
  if (!stream_) throw ReadError(path + ": cannot be opened: " + std::strerror(errno));
  struct stat status {};
  if (fstat(fileno(stream_.get()), &status) != 0)
    throw ReadError(path + ": cannot be read: " + std::strerror(errno));
  if (!S_ISREG(status.st_mode)) throw ReadError(path + ": is not a file");
  size_ = uint64_t(status.st_size);
}

bool InputFile::seek(uint64_t position) const {
  return fseeko(stream_.get(), off_t(position), SEEK_SET) == 0;
}

bool is_writable(const std::string& path) {
  return access(path.c_str(), W_OK) == 0;
}

std::string make_temporary_folder(const std::string& beginning, std::error_code& error) {
  std::string path = beginning + "XXXXXX";
  error.clear();
  if (!mkdtemp(path.data())) error.assign(errno, std::generic_category());
  return path;
}

std::vector<std::string> files_of_pattern(const std::string& pattern) {
  std::vector<std::string> files;
  glob_t found{};
  if (glob(pattern.c_str(), 0, nullptr, &found) == 0)
    files.assign(found.gl_pathv, found.gl_pathv + found.gl_pathc);
  globfree(&found);
  return files;
}

}  // namespace duet
