// Everything that the reader of pbrt files knows, as text: from the tables that it reads by.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "pbrt/records.h"

namespace duet::pbrt {

/// One plugin of any kind.
struct Row {
  std::string_view kind;  ///< the directive
  std::string_view name;
  Versions versions;
  Status status;
  std::string_view note;
  std::span<const Spec> parameters, more;
};

/// All plugins, kind by kind.
std::vector<Row> all_rows();
/// The tables as a page of Markdown: docs/pbrt.md.
std::string vocabulary_markdown();

// Each appends the plugins of a file.
void list_shapes(std::vector<Row>& rows);
void list_lights(std::vector<Row>& rows);
void list_area_lights(std::vector<Row>& rows);
void list_materials(std::vector<Row>& rows);
void list_textures(std::vector<Row>& rows);
void list_media(std::vector<Row>& rows);
void list_cameras(std::vector<Row>& rows);
void list_films(std::vector<Row>& rows);
void list_integrators(std::vector<Row>& rows);

template <class Read>
void list(std::vector<Row>& rows, std::string_view kind, std::span<const Record<Read>> table,
          std::span<const Spec> more = {}) {
  for (const Record<Read>& r : table)
    rows.push_back({kind, r.name, r.versions, r.status, r.note, r.parameters, more});
}

template <class Read, size_t N>
void list(std::vector<Row>& rows, std::string_view kind, const Record<Read> (&table)[N],
          std::span<const Spec> more = {}) {
  list(rows, kind, std::span<const Record<Read>>(table), more);
}

}  // namespace duet::pbrt
