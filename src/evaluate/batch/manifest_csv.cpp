// Manifests with a job in each row.
#include <algorithm>

#include "base/printable.h"
#include "evaluate/batch/csv.h"
#include "evaluate/batch/manifest_fields.h"

namespace duet::batch {

namespace {

/// What separates values of one field.
constexpr char kSeparator = ';';

struct ManifestColumn {
  std::string name;
  std::optional<OptionKind> kind;
};

bool has_scene(const std::vector<ManifestColumn>& columns) {
  return std::any_of(columns.begin(), columns.end(),
                     [](const ManifestColumn& c) { return c.name == "scene"; });
}

std::vector<ManifestColumn> manifest_columns(const CsvRow& head, ManifestFields& fields) {
  std::vector<ManifestColumn> columns;
  const SourceLocation where{fields.file(), head.line, 0};
  for (const std::string& name : head.fields) {
    const auto has_name = [&](const ManifestColumn& c) { return c.name == name; };
    if (std::any_of(columns.begin(), columns.end(), has_name))
      fields.diagnostics().error(where, "there are two columns \"{}\"", printable(name));
    columns.push_back({name, fields.kind(name, where)});
  }
  if (!has_scene(columns))
    fields.diagnostics().error(where, "the first row has no column \"scene\"");
  return columns;
}

std::vector<std::string> split(const std::string& field) {
  std::vector<std::string> values;
  for (size_t from = 0; from <= field.size();) {
    const size_t to = std::min(field.find(kSeparator, from), field.size());
    values.push_back(field.substr(from, to - from));
    from = to + 1;
  }
  return values;
}

}  // namespace

void read_manifest_csv(const std::string& text, ManifestFields& fields, std::vector<Job>& jobs) {
  const std::vector<CsvRow> rows = read_csv(text, fields.file(), fields.diagnostics());
  if (rows.empty()) return;
  const std::vector<ManifestColumn> columns = manifest_columns(rows[0], fields);
  for (size_t r = 1; r < rows.size(); ++r) {
    const CsvRow& row = rows[r];
    Job job;
    job.where = {fields.file(), row.line, 0};
    if (row.fields.size() != columns.size()) {
      fields.diagnostics().error(job.where, "{} field{} for {} columns", row.fields.size(),
                                 row.fields.size() == 1 ? "" : "s", columns.size());
      continue;
    }
    for (size_t c = 0; c < columns.size(); ++c) {
      if (!columns[c].kind) continue;
      const bool is_list = *columns[c].kind == OptionKind::repeatable;
      fields.set(job, columns[c].name, *columns[c].kind,
                 is_list ? split(row.fields[c]) : std::vector{row.fields[c]});
    }
    // That there is no such column has been said.
    if (has_scene(columns)) fields.finish(std::move(job), jobs);
  }
}

}  // namespace duet::batch
