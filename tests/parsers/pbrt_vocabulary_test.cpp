// The tables of pbrt's plugins.
#include "pbrt/vocabulary.h"

#include <doctest/doctest.h>

#include <set>
#include <tuple>

#include "support/files.h"
#include "support/source_path.h"

using namespace duet;
using namespace duet::test;

TEST_CASE("docs/pbrt.md is what the tables of pbrt say") {
  // Otherwise: duet plugins --pbrt > docs/pbrt.md
  CHECK(read_file(source_path("docs/pbrt.md")) == pbrt::vocabulary_markdown());
}

TEST_CASE("pbrt tables: names are unique per version, and what is refused says why") {
  for (const pbrt::Version v : {pbrt::Version::v3, pbrt::Version::v4}) {
    std::set<std::pair<std::string_view, std::string_view>> seen;
    for (const pbrt::Row& row : pbrt::all_rows()) {
      if (!pbrt::has_version(row.versions, v)) continue;
      INFO(row.kind, " ", row.name);
      CHECK(seen.emplace(row.kind, row.name).second);
      if (row.status == pbrt::Status::refused) CHECK(!row.note.empty());
      std::set<std::string_view> parameters;
      for (const auto list : {row.parameters, row.more})
        for (const pbrt::Spec& s : list)
          if (pbrt::has_version(s.versions, v)) {
            INFO(s.name);
            CHECK(parameters.insert(s.name).second);
            CHECK(s.types != 0);
          }
    }
    CHECK(seen.size() > 50);
  }
}
