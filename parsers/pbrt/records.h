// The tables of pbrt's plugins: what each is called, what it is read by, and how much of it there
// is.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "pbrt/reader.h"
#include "values/text.h"

namespace duet::pbrt {

/// One plugin. Null instead of a function: it is refused, and the note says why.
template <class Read>
struct Record {
  std::string_view name;
  Versions versions;
  Status status;
  std::string_view note;
  std::span<const Spec> parameters;
  Read read;
};

/// The record of a plugin in the version of the file. Null after an error: there is none, or it is
/// refused. Plugins of the other version may stand in a table of their own.
template <class Read>
const Record<Read>* find_record(Reader& reader, const Plugin& plugin,
                                std::span<const Record<Read>> table,
                                std::span<const Record<Read>> of_other_version = {}) {
  std::vector<std::string> names;
  const Record<Read>* other = nullptr;
  for (const Record<Read>& r : of_other_version)
    if (r.name == plugin.name) other = &r;
  for (const Record<Read>& r : table) {
    if (!has_version(r.versions, reader.version())) {
      if (r.name == plugin.name) other = &r;
      continue;
    }
    names.emplace_back(r.name);
    if (r.name != plugin.name) continue;
    if (r.read) return &r;
    reader.report().error(plugin.where, "{} \"{}\" is not supported: {}", plugin.directive, r.name,
                          r.note);
    return nullptr;
  }
  const int version = int(reader.version());
  if (other)
    reader.report().error(plugin.where,
                          "{} \"{}\" is pbrt-v{}'s, and this file is read as pbrt-v{} "
                          "(--pbrt-version {} reads it otherwise)",
                          plugin.directive, plugin.name, version == 3 ? 4 : 3, version,
                          version == 3 ? 4 : 3);
  else
    reader.report().error(plugin.where, "there is no {} {}{}", plugin.directive,
                          in_quotes(plugin.name), did_you_mean(plugin.name, names));
  return nullptr;
}

}  // namespace duet::pbrt
