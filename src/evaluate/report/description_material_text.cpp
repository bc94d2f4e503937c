#include <filesystem>

#include "evaluate/report/description_text.h"
#include "evaluate/report/overloaded.h"

namespace duet {

namespace {

/// The parts of the line about a BSDF.
struct BsdfLine {
  std::string roughness;                 ///< follows the name
  std::string values;                    ///< then what the fields say
  std::vector<std::string> nested;       ///< then what is nested
  std::vector<std::string_view> places;  ///< what each of these is there, if they differ
};

}  // namespace

std::string DescriptionText::material(MaterialId id) const {
  const MaterialModel& model = scene_.materials[size_t(id)].model;
  BsdfLine line;
  const auto show_rough = [&](const Roughness& r) {
    const std::string u = input(r.alpha_u), v = input(r.alpha_v);
    line.roughness = fmt::format(" ({}, alpha {})", kMicrofacetNames[size_t(r.distribution)],
                                 u == v ? u : u + " and " + v);
  };
  model.for_each_field([&](const FieldFacts& facts, const FieldValue& value) {
    if (!facts.given) return;
    with_value(value,
               Overloaded{
                   [&](const std::string& v) {
                     if (is_shown(facts))
                       show(line.values, facts, std::filesystem::path(v).filename().string());
                   },
                   [&](const Roughness& r) { show_rough(r); },
                   [&](const std::optional<Roughness>& r) {
                     if (r) show_rough(*r);
                   },
                   [&](const MaterialId& nested) {
                     line.nested.push_back(material(nested));
                     line.places.push_back(facts.shown);
                   },
                   [&](const MaterialShares& shares) {
                     for (const auto& [weight, part] : shares)
                       line.nested.push_back(fmt::format("{:.4g} of {}", weight, material(part)));
                   },
                   [&](const auto& v) {
                     if (is_shown(facts)) show(line.values, facts, v);
                   },
               });
  });
  // Where only one is nested, it is clear which.
  for (size_t i = 0; i < line.places.size() && line.nested.size() > 1; ++i)
    line.nested[i].insert(0, line.places[i]);
  std::string text = model.name() + line.roughness + line.values;
  if (!line.nested.empty()) text += fmt::format(" [{}]", fmt::join(line.nested, "; "));
  return text;
}

}  // namespace duet
