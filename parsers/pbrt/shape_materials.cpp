// Materials of pbrt-v3 that a shape changes.
#include <algorithm>
#include <iterator>

#include "pbrt/materials.h"
#include "pbrt/shape_readers.h"

namespace duet::pbrt {

namespace {

/// Whether the material of that name has a parameter of that name and type.
bool material_has(std::string_view material, const Parameter& p) {
  const auto fits = [&](const Spec& s) {
    return s.name == p.name && has_version(s.versions, Version::v3) && (s.types & of(p.type));
  };
  const auto table = materials_v3();
  const auto record = std::ranges::find(table, material, &Record<ReadMaterial>::name);
  if (record == table.end() || !record->read) return false;
  // What lets everything pass has no parameters, common ones neither.
  if (record->parameters.empty()) return false;
  return std::ranges::any_of(record->parameters, fits) || std::ranges::any_of(kMaterialSpecs, fits);
}

}  // namespace

std::optional<MaterialId> take_material(Reader& reader, Plugin& shape) {
  if (reader.version() != Version::v3 || shape.parameters.empty()) return std::nullopt;
  const auto& current = reader.state().material_plugin;
  constexpr const char* kDefault = "matte";
  const std::string_view name = current ? std::string_view(current->name) : kDefault;
  std::vector<Parameter> own;
  std::erase_if(shape.parameters, [&](Parameter& p) {
    const bool takes = !shape_has(shape.name, p.name) && material_has(name, p);
    if (takes) own.push_back(std::move(p));
    return takes;
  });
  if (own.empty()) return std::nullopt;
  Plugin material = current ? *current : Plugin{"Material", kDefault, shape.where, {}};
  std::erase_if(material.parameters, [&](const Parameter& p) {
    return std::ranges::any_of(own, [&](const Parameter& q) { return q.name == p.name; });
  });
  std::ranges::move(own, std::back_inserter(material.parameters));
  return read_material(reader, material);
}

}  // namespace duet::pbrt
