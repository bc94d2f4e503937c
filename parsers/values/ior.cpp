#include "values/ior.h"

#include <algorithm>
#include <cctype>

namespace duet {

namespace {

// Source: Hecht, "Optics", 4th edition, as listed by Mitsuba (render/ior.h), BSD-3-Clause.
constexpr DielectricEntry kDielectrics[] = {
    {"vacuum", 1.0},      {"helium", 1.000036},        {"hydrogen", 1.000132},
    {"air", 1.000277},    {"carbon dioxide", 1.00045}, {"water", 1.3330},
    {"acetone", 1.36},    {"ethanol", 1.361},          {"carbon tetrachloride", 1.461},
    {"glycerol", 1.4729}, {"benzene", 1.501},          {"silicone oil", 1.52045},
    {"bromine", 1.661},   {"water ice", 1.31},         {"fused quartz", 1.458},
    {"pyrex", 1.470},     {"acrylic glass", 1.49},     {"polypropylene", 1.49},
    {"bk7", 1.5046},      {"sodium chloride", 1.544},  {"amber", 1.55},
    {"pet", 1.5750},      {"diamond", 2.419},
};

bool equal_in_any_case(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](unsigned char x, unsigned char y) {
    return std::tolower(x) == std::tolower(y);
  });
}

}  // namespace

std::span<const DielectricEntry> dielectrics() {
  return kDielectrics;
}

std::optional<double> find_dielectric(std::string_view name) {
  for (const DielectricEntry& e : kDielectrics)
    if (equal_in_any_case(name, e.name)) return e.ior;
  return std::nullopt;
}

const ConductorEntry* find_conductor(std::string_view name) {
  for (const ConductorEntry& e : conductors())
    if (name == e.name) return &e;
  return nullptr;
}

const Spectrum* index_of_file(std::string_view part, std::string_view file) {
  constexpr std::string_view folder = "data/ior/";
  const bool real = part == "eta";
  const std::string_view ending = real ? ".eta.spd" : ".k.spd";
  if ((!real && part != "k") || !file.starts_with(folder) || !file.ends_with(ending))
    return nullptr;
  file.remove_prefix(folder.size());
  file.remove_suffix(ending.size());
  const ConductorEntry* entry = find_conductor(file);
  if (!entry) return nullptr;
  return real ? &entry->eta : &entry->k;
}

std::vector<std::string> dielectric_names() {
  std::vector<std::string> names;
  for (const DielectricEntry& e : kDielectrics) names.push_back(e.name);
  return names;
}

std::vector<std::string> conductor_names() {
  std::vector<std::string> names{"none"};
  for (const ConductorEntry& e : conductors()) names.push_back(e.name);
  return names;
}

}  // namespace duet
