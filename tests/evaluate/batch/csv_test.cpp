#include "evaluate/batch/csv.h"

#include <doctest/doctest.h>

#include "evaluate/report/csv_field.h"

using namespace duet;
using namespace duet::batch;

namespace {

struct Table {
  std::vector<CsvRow> rows;
  Diagnostics diagnostics;
  std::string errors() const {
    std::string all;
    for (const Diagnostic& d : diagnostics.all()) all += d.to_string() + "\n";
    return all;
  }
};

Table table_of(const std::string& text) {
  Table table;
  table.rows = read_csv(text, std::make_shared<const std::string>("t.csv"), table.diagnostics);
  return table;
}

using Fields = std::vector<std::string>;

}  // namespace

TEST_CASE("fields are parted by commas, and quotes hold what means something otherwise") {
  const Table t =
      table_of("\xef\xbb\xbfone,two\r\n\r\n\"a,b\",\"say \"\"x\"\"\"\n\n,\"two\r\nlines\"\nlast");
  CHECK(t.errors().empty());
  REQUIRE(t.rows.size() == 4);
  CHECK(t.rows[0].fields == Fields{"one", "two"});
  CHECK(t.rows[1].fields == Fields{"a,b", "say \"x\""});
  CHECK(t.rows[1].line == 3);
  CHECK(t.rows[2].fields == Fields{"", "two\r\nlines"});
  CHECK(t.rows[2].line == 5);
  CHECK(t.rows[3].fields == Fields{"last"});
  CHECK(t.rows[3].line == 7);
  CHECK(table_of("a,\n").rows[0].fields == Fields{"a", ""});
  CHECK(table_of("").rows.empty());
  CHECK(table_of("\n\r\n").rows.empty());
}

TEST_CASE("quotes that are not as they should be are errors at their lines") {
  CHECK(table_of("a\n\"b\nc").errors() ==
        "t.csv:2: error: a quote that begins here does not end\n");
  CHECK(table_of("a\n\"b\" c,d").errors() ==
        "t.csv:2: error: text follows the quote at the end of a field\n");
  CHECK(table_of("a\n\nx\"y\n").errors() ==
        "t.csv:3: error: a quote within a field that does not begin with one: \"x\"y\"\n");
}

TEST_CASE("what is written as a field is read again") {
  for (const char* value : {"", "plain", "a,b", "\"", "two\nlines", "two\r\nlines", "\"\",\"\""}) {
    CAPTURE(value);
    const Table t = table_of("x," + csv_field(value) + ",y\n");
    CHECK(t.errors().empty());
    REQUIRE(t.rows.size() == 1);
    CHECK(t.rows[0].fields == Fields{"x", value, "y"});
  }
  CHECK(csv_field("plain") == "plain");
}
