#include "base/readable.h"

#include <doctest/doctest.h>
#include <sys/stat.h>
#include <unistd.h>

#include "support/files.h"

using namespace duet;
using duet::test::TemporaryDirectory;

TEST_CASE("a file that cannot be read has a reason") {
  const TemporaryDirectory place;
  CHECK(unreadable_reason(place.write("file", "x")) == "");
  CHECK(unreadable_reason(place.path("missing")) == "No such file or directory");
  CHECK(unreadable_reason(place.path("file/within")) == "Not a directory");
  CHECK(unreadable_reason(place.path("")) == "it is a directory");
  CHECK(unreadable_reason("/dev/null") == "it is not a regular file");
  mkfifo(place.path("pipe").c_str(), 0600);
  CHECK(unreadable_reason(place.path("pipe")) == "it is not a regular file");
  if (geteuid() == 0) return;  // whom no permission stops
  chmod(place.path("file").c_str(), 0);
  CHECK(unreadable_reason(place.path("file")) == "Permission denied");
}
