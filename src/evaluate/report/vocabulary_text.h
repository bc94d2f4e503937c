// The vocabulary as text for people: docs/compatibility.md and `duet plugins` are made of it.
#pragma once

#include <string>

#include "mitsuba/vocabulary.h"

namespace duet {

/// Every plugin and parameter of Mitsuba 0.6 and 3 with what Duet does with it, as the Markdown of
/// docs/compatibility.md. It ends with a line feed.
std::string compatibility_markdown();

/// One section of it: a heading and the plugins of one kind.
std::string compatibility_section(PluginKind kind,
                                  const Vocabulary& vocabulary = Vocabulary::built_in());

/// The plugins of one kind and their parameters, a line each, as `duet plugins` prints them.
std::string plugin_list(PluginKind kind, const Vocabulary& vocabulary = Vocabulary::built_in());

/// "done", "approximated", … as both show it.
std::string_view support_name(Support support);
/// "0.x", "3.x" or "0.x, 3.x".
std::string_view versions_name(FileVersions versions);

}  // namespace duet
