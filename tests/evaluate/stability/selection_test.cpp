// Rows and methods by their names.
#include "evaluate/stability/selection.h"

#include <doctest/doctest.h>

using namespace duet;
using namespace duet::stability;

namespace {

std::vector<std::string> names(const std::vector<const Row*>& rows) {
  std::vector<std::string> all;
  for (const Row* row : rows) all.push_back(row->name);
  return all;
}

using Names = std::vector<std::string>;

}  // namespace

TEST_CASE("selection: rows by name and by number, in the order of the catalogue") {
  Catalogue catalogue;
  for (const char* name : {"mirror", "glass", "fog"}) {
    Row& row = catalogue.rows.emplace_back();
    row.name = name;
    row.number = int(catalogue.rows.size()) - 1;
    row.fast = row.name != "fog";
  }
  CHECK(names(select_rows(catalogue, {}, false)) == Names{"mirror", "glass", "fog"});
  CHECK(names(select_rows(catalogue, {}, true)) == Names{"mirror", "glass"});
  CHECK(names(select_rows(catalogue, {"2", "mirror"}, false)) == Names{"mirror", "fog"});
  CHECK_THROWS_WITH_AS(
      select_rows(catalogue, {"glas"}, false),
      "there is no case \"glas\" (did you mean \"glass\"?); duet stability --list names them",
      std::out_of_range);
  // A number of zero is none.
  CHECK_THROWS_AS(select_rows(catalogue, {"0"}, false), std::out_of_range);
  CHECK_THROWS_WITH_AS(select_rows(catalogue, {"fog"}, true),
                       "none of these cases is part of --fast", std::out_of_range);
}

TEST_CASE("selection: methods by their names") {
  CHECK(select_methods({}).size() == kMethods.size());
  CHECK(select_methods({"vcm", "path"}) == Names{"vcm", "path"});
  CHECK_THROWS_AS(select_methods({"path", "bdtp"}), std::out_of_range);
}
