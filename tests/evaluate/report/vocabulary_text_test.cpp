// The list of plugins that people read.
#include "evaluate/report/vocabulary_text.h"

#include <doctest/doctest.h>

#include <set>
#include <sstream>

#include "scene/mitsuba_differences.h"
#include "support/files.h"
#include "support/source_path.h"
#include "support/texts.h"
#include "values/text.h"

using namespace duet;
using namespace duet::test;

namespace {

/// The cells of a row of a table; "\|" is no border.
size_t cells(const std::string& row) {
  size_t borders = 0;
  for (size_t i = 0; i < row.size(); ++i)
    borders += row[i] == '|' && (i == 0 || row[i - 1] != '\\');
  return borders - 1;
}

}  // namespace

TEST_CASE("docs/compatibility.md is what the tables say") {
  // Otherwise: duet plugins --markdown > docs/compatibility.md
  CHECK(read_file(source_path("docs/compatibility.md")) ==
        compatibility_markdown() + "\n" + mitsuba_differences_markdown());
}

TEST_CASE("every plugin and every parameter is listed with its status") {
  for (int k = 0; k < kPluginKinds; ++k) {
    const std::string section = compatibility_section(PluginKind(k));
    for (const Plugin& p : Vocabulary::built_in().plugins(PluginKind(k))) {
      CAPTURE(p.name);
      CHECK(contains(section, fmt::format("| `{}` | {} | {} |", p.name, versions_name(p.versions),
                                          support_name(p.support))));
      for (const Parameter& q : p.parameters)
        CHECK(contains(section, fmt::format("| `{}` | {} |", q.name, type_name(q.type))));
      for (const std::string_view q : split_list(p.refused_parameters))
        CHECK(contains(section, fmt::format("`{}`", q)));
    }
    for (const Parameter& q : common_parameters(PluginKind(k)))
      CHECK(contains(section, fmt::format("| `{}` | {} |", q.name, type_name(q.type))));
  }
}

TEST_CASE("names of refused parameters are snake_case and unique") {
  for (int k = 0; k < kPluginKinds; ++k)
    for (const Plugin& p : Vocabulary::built_in().plugins(PluginKind(k))) {
      std::set<std::string_view> seen;
      for (const std::string_view name : split_list(p.refused_parameters)) {
        CAPTURE(name);
        CHECK(seen.insert(name).second);
        CHECK((name.size() == 1 || snake_case(name) == name));
      }
    }
}

TEST_CASE("tables have as many cells in each row as in their head") {
  std::istringstream in(compatibility_markdown() + "\n" + mitsuba_differences_markdown());
  size_t columns = 0, rows = 0;
  for (std::string line; std::getline(in, line);) {
    if (!line.starts_with('|')) {
      columns = 0;
      continue;
    }
    if (columns == 0) columns = cells(line);
    CAPTURE(line);
    CHECK(cells(line) == columns);
    ++rows;
  }
  CHECK(rows > 500);
}

TEST_CASE("what is approximated, ignored or refused is explained") {
  for (int k = 0; k < kPluginKinds; ++k)
    for (const Plugin& p : Vocabulary::built_in().plugins(PluginKind(k))) {
      CAPTURE(p.name);
      if (p.support == Support::approximated || p.support == Support::refused)
        CHECK(!p.note.empty());
      for (const Parameter& q : p.parameters)
        if (q.support == Support::approximated) CHECK(!q.note.empty());
    }
}
