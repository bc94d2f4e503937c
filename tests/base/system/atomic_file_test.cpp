#include "base/system/atomic_file.h"

#include <doctest/doctest.h>
#include <fcntl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>

#include "support/files.h"

using namespace duet;
using namespace duet::test;

TEST_CASE("a file is replaced as a whole, and a symbolic link stays one") {
  TemporaryDirectory directory;
  const std::string path = directory.write("a", "old");
  write_file_atomically(path, bytes_of("new contents"));
  CHECK(read_file(path) == "new contents");
  std::filesystem::create_symlink(path, directory.path("link"));
  write_file_atomically(directory.path("link"), bytes_of("through the link"));
  CHECK(std::filesystem::is_symlink(directory.path("link")));
  CHECK(read_file(path) == "through the link");
  CHECK(directory.count() == 2);
}

TEST_CASE("a temporary name that is taken is no obstacle, and what has it stays") {
  TemporaryDirectory directory;
  const std::string path = directory.write("a", "old");
  const std::string taken = directory.write("a." + std::to_string(getpid()) + "-0.tmp", "other");
  write_file_atomically(path, "new text");
  CHECK(read_file(path) == "new text");
  CHECK(read_file(taken) == "other");
  CHECK(directory.count() == 2);
}

TEST_CASE("what cannot be written leaves nothing behind") {
  TemporaryDirectory directory;
  CHECK_THROWS_WITH_AS(write_file_atomically(directory.path("no/such"), bytes_of("x")),
                       doctest::Contains("No such file or directory"), std::runtime_error);
  const std::string file = directory.write("file", "x");
  CHECK_THROWS_WITH_AS(write_file_atomically(file + "/below", bytes_of("x")),
                       doctest::Contains("cannot be written"), std::runtime_error);
  CHECK_THROWS_WITH_AS(write_file_atomically(directory.path("."), bytes_of("x")),
                       doctest::Contains("not a regular file"), std::runtime_error);
  CHECK_THROWS_WITH_AS(write_file_atomically("/dev/full", bytes_of("x")),
                       doctest::Contains("not a regular file"), std::runtime_error);
  CHECK(directory.count() == 1);
}

TEST_CASE("a disk that fills up keeps the old file and no new one") {
  // A limit on the size of files stands in for the full disk: the write stops halfway.
  TemporaryDirectory directory;
  const std::string path = directory.write("image.exr", "old");
  rlimit before;
  getrlimit(RLIMIT_FSIZE, &before);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit small{1000, before.rlim_max};
  setrlimit(RLIMIT_FSIZE, &small);
  std::string message;
  try {
    write_file_atomically(path, bytes_of(std::string(5000, 'x')));
  } catch (const std::runtime_error& e) {
    message = e.what();
  }
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  CHECK(message == path + " cannot be written: File too large");
  CHECK(read_file(path) == "old");
  CHECK(directory.count() == 1);
}

TEST_CASE("a file that is not whole has no name that could stay") {
  TemporaryDirectory directory;
  // Not every file system can do this.
  const int probe = open(directory.path(".").c_str(), O_WRONLY | O_TMPFILE | O_CLOEXEC, 0666);
  if (probe < 0) return;
  close(probe);
  AtomicFile file(directory.path("a"));
  file.write("text");
  file.sync();
  CHECK(directory.count() == 0);
  file.commit();
  CHECK(directory.count() == 1);
  CHECK(read_file(directory.path("a")) == "text");
}

TEST_CASE("a file that is written in pieces is there when it is whole") {
  TemporaryDirectory directory;
  const std::string path = directory.write("a", "old");
  {
    AtomicFile file(path);
    file.write("first, ");
    file.write("second");
    CHECK(file.path() == path);
    CHECK(read_file(path) == "old");
    file.commit();
  }
  CHECK(read_file(path) == "first, second");
  {
    AtomicFile file(path);
    file.write("x");
  }
  CHECK(read_file(path) == "first, second");
  CHECK(directory.count() == 1);
}
