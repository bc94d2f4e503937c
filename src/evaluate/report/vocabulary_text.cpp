#include "evaluate/report/vocabulary_text.h"

#include <algorithm>

#include "values/text.h"

namespace duet {

namespace {

constexpr std::string_view kIntroduction = R"(# Compatibility with Mitsuba

Every plugin and parameter of Mitsuba 0.6 and 3, and what Duet does with it; Duet's own are among
them. This file is printed by `duet plugins --markdown` from the tables that the reader itself uses;
a test compares the two. The last section, "Where Mitsuba is off", lists what is rendered otherwise
because Mitsuba is believed to be wrong.

| Status | Meaning |
|---|---|
| done | rendered as Mitsuba does |
| approximated | rendered, differently; `duet info` says so for the scene at hand |
| no effect | accepted without a word: it changes nothing that Duet computes |
| ignored | accepted with a warning: it does not change the linear image |
| refused | an error that gives the reason |

Names are those of Mitsuba 3. All files may also write them as Mitsuba 0.x does (`toWorld` for
`to_world`), and a name that only one version has is understood in files of both. Where two defaults
are given, the second is that of 0.x files. Ways to write scenes other than by plugins and
parameters are listed in [constructs.md](constructs.md).
)";

constexpr std::string_view heading(PluginKind kind) {
  constexpr std::string_view names[kPluginKinds] = {"Scene",
                                                    "Integrators",
                                                    "Sensors",
                                                    "Films",
                                                    "Reconstruction filters",
                                                    "Samplers",
                                                    "Shapes",
                                                    "BSDFs",
                                                    "Textures and spectra",
                                                    "Emitters",
                                                    "Media",
                                                    "Phase functions",
                                                    "Volumes",
                                                    "Subsurface scattering"};
  return names[size_t(kind)];
}

/// A cell of a table: "|" would end it.
std::string cell(std::string_view text) {
  std::string out;
  for (const char c : text) out += c == '|' ? std::string("\\|") : std::string(1, c);
  return out;
}

std::string code(std::string_view text) {
  return text.empty() ? std::string() : "`" + cell(text) + "`";
}

std::string preset_of(const Parameter& p) {
  const auto show = [](std::string_view preset) {
    if (preset.empty() || preset.front() != '(') return code(preset);
    return cell(preset.substr(1, preset.size() - 2));
  };
  if (p.required) return "required";
  if (p.preset_0x.empty()) return show(p.preset);
  return show(p.preset) + "; " + show(p.preset_0x);
}

/// The further names of a thing: "also `a`, `b`".
std::string also(std::string_view aliases) {
  std::string out;
  for (const std::string_view name : split_list(aliases))
    out += (out.empty() ? "also " : ", ") + code(name);
  return out;
}

std::string joined(std::string_view a, std::string_view b) {
  return std::string(a) + (a.empty() || b.empty() ? "" : "; ") + std::string(b);
}

std::string parameter_rows(const ParameterList& parameters) {
  std::string out =
      "| Parameter | Type | Default | Files | Status | |\n|---|---|---|---|---|---|\n";
  for (const Parameter& p : parameters)
    out += fmt::format("| {} | {} | {} | {} | {} | {} |\n", code(p.name), type_name(p.type),
                       preset_of(p), versions_name(p.versions), support_name(p.support),
                       joined(cell(p.note), also(p.aliases)));
  return out;
}

std::string only_in(FileVersions v) {
  return v == FileVersions::all ? "" : fmt::format(", {} only", versions_name(v));
}

std::string parameter_line(const Parameter& p) {
  std::string line =
      fmt::format("    {:28} {:12} {}", p.name, support_name(p.support), type_name(p.type));
  if (p.required) line += ", required";
  if (!p.preset.empty()) line += fmt::format(", default {}", p.preset);
  if (!p.preset_0x.empty()) line += fmt::format(" (in 0.x {})", p.preset_0x);
  line += only_in(p.versions);
  if (!p.aliases.empty()) line += fmt::format(", also {}", p.aliases);
  if (!p.note.empty()) line += fmt::format(": {}", p.note);
  return line + "\n";
}

}  // namespace

std::string_view support_name(Support support) {
  switch (support) {
    case Support::done:
      return "done";
    case Support::approximated:
      return "approximated";
    case Support::inert:
      return "no effect";
    case Support::ignored:
      return "ignored";
    case Support::refused:
      return "refused";
  }
  return "";
}

std::string_view versions_name(FileVersions versions) {
  switch (versions) {
    case FileVersions::all:
      return "0.x, 3.x";
    case FileVersions::v0:
      return "0.x";
    case FileVersions::v3:
      return "3.x";
  }
  return "";
}

std::string compatibility_section(PluginKind kind, const Vocabulary& vocabulary) {
  std::string out = fmt::format("## {}\n\n", heading(kind));
  out += "| Plugin | Files | Status | |\n|---|---|---|---|\n";
  for (const Plugin& p : vocabulary.plugins(kind)) {
    std::string others;
    for (const std::string_view name : split_list(p.refused_parameters))
      others += (others.empty() ? "parameters " : ", ") + code(name);
    out +=
        fmt::format("| {} | {} | {} | {} |\n", code(p.name), versions_name(p.versions),
                    support_name(p.support), joined(joined(cell(p.note), also(p.aliases)), others));
  }
  if (const auto& common = common_parameters(kind); !common.empty())
    out += "\nParameters of all of them:\n\n" + parameter_rows(common);
  for (const Plugin& p : vocabulary.plugins(kind))
    if (!p.parameters.empty())
      out += fmt::format("\n### {}\n\n", code(p.name)) + parameter_rows(p.parameters);
  return out;
}

std::string compatibility_markdown() {
  std::string out(kIntroduction);
  for (int i = 0; i < kPluginKinds; ++i) out += "\n" + compatibility_section(PluginKind(i));
  return out;
}

std::string plugin_list(PluginKind kind, const Vocabulary& vocabulary) {
  std::string out;
  for (const Plugin& p : vocabulary.plugins(kind)) {
    out += fmt::format("{} {:{}} {}{}{}{}\n", tag_of(kind), p.name, 31 - int(tag_of(kind).size()),
                       support_name(p.support), only_in(p.versions),
                       p.aliases.empty() ? "" : fmt::format(", also {}", p.aliases),
                       p.note.empty() ? "" : fmt::format(": {}", p.note));
    for (const Parameter& q : p.parameters) out += parameter_line(q);
  }
  if (common_parameters(kind).empty()) return out;
  out += fmt::format("every {}\n", tag_of(kind));
  for (const Parameter& q : common_parameters(kind)) out += parameter_line(q);
  return out;
}

}  // namespace duet
