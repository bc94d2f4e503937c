#include "base/printable.h"

#include <doctest/doctest.h>

using duet::printable;

TEST_CASE("text in UTF-8 stays as it is") {
  for (const char* text : {"", "plain text, <b> & \"quotes\"", "grün, 光, 🙂", "two\nlines"})
    CHECK(printable(text) == text);
}

TEST_CASE("what terminals and XML do not take is replaced") {
  CHECK(printable("a\tb") == "a b");
  for (const char* bad : {"\x1b", "\x01", "\r", "\x7f", "\xc2\x9b", "\xff", "\xc3", "\xc0\x80"}) {
    const std::string shown = printable(std::string("a") + bad + "b");
    CAPTURE(shown);
    CHECK(shown.starts_with("a\xef\xbf\xbd"));
    CHECK(shown.ends_with("b"));
    CHECK(shown.find(bad) == shown.npos);
  }
  // Surrogates, numbers beyond Unicode, longer forms than needed, and what XML forbids.
  for (const char* bad : {"\xed\xa0\x80", "\xf4\x90\x80\x80", "\xe0\x80\xaf", "\xf0\x80\x80\xaf",
                          "\xef\xbf\xbf", "\xef\xbf\xbe", "\xe5\x85"})
    CHECK(printable(bad).find(bad) == std::string::npos);
  CHECK(printable(std::string_view("\0", 1)) == "\xef\xbf\xbd");
}
