#include "mitsuba/material_library.h"

#include <cmath>

#include "files/file_access.h"
#include "math/spectrum.h"
#include "values/text.h"

namespace duet {

MaterialLibrary::MaterialLibrary(const std::string& file, const std::vector<MtlMaterial>& materials,
                                 std::vector<std::string> folders, const FileVersion& version)
    : file_(std::make_shared<std::string>(file)),
      folders_(std::make_shared<std::vector<std::string>>(std::move(folders))),
      version_(version) {
  for (const MtlMaterial& m : materials) materials_[m.name] = m;
}

const Node* MaterialLibrary::find(const std::string& name, const FileAccess& files,
                                  Report& report) {
  const auto material = materials_.find(name);
  if (material == materials_.end()) return nullptr;
  const auto [entry, is_new] = made_.try_emplace(name);
  if (is_new) entry->second = make(material->second, files, report);
  return entry->second;
}

Node& MaterialLibrary::add(PluginKind kind, const char* type, int line) {
  Node& node = nodes_.emplace_back();
  node.kind = kind;
  node.plugin = Vocabulary::built_in().find(kind, type);
  node.type = type;
  node.version = version_;
  node.where = place(line);
  node.folders = folders_;
  return node;
}

void MaterialLibrary::set(Node& node, const std::string& name, PropertyValue value,
                          int line) const {
  const SourceLocation where = line > 0 ? place(line) : node.where;
  node.properties.push_back({name, name, std::move(value), where, where});
}

PropertyValue MaterialLibrary::image(const Value& v, bool linear, const FileAccess& files,
                                     Report& report) {
  const auto [entry, is_new] = images_.try_emplace({v.image, linear});
  if (!is_new) return entry->second;
  auto path = find_file(v.image, *folders_, files);
  // Such names are often paths of another computer.
  if (!path) path = find_file(v.image.substr(v.image.find_last_of("/\\") + 1), *folders_, files);
  if (!path) {
    report.warning(place(v.line), "{}: black instead", not_found(v.image, *folders_));
    return entry->second = RgbColor{};
  }
  Node& texture = add(PluginKind::texture, "bitmap", v.line);
  set(texture, "filename", absolute_path(*path), v.line);
  if (linear) set(texture, "gamma", 1.0, v.line);
  return entry->second = static_cast<const Node*>(&texture);
}

PropertyValue MaterialLibrary::color(const Value& v, const FileAccess& files, Report& report) {
  if (!v.image.empty()) return image(v, false, files, report);
  RgbColor rgb;
  for (size_t i = 0; i < 3; ++i) rgb.value[i] = double(srgb_to_linear(float(v.numbers[i])));
  if (std::isfinite(rgb.value[0] + rgb.value[1] + rgb.value[2])) return rgb;
  report.error(place(v.line), "the colour is too bright to be a number");
  return Broken{};
}

const Node* MaterialLibrary::make(const MtlMaterial& m, const FileAccess& files, Report& report) {
  const auto is_black = [](const Value& v) {
    return v.image.empty() && v.numbers == std::array<double, 3>{};
  };
  Node* node = nullptr;
  if (m.illum == 2 && !is_black(m.specular) && !is_black(m.exponent)) {
    node = &add(PluginKind::bsdf, "phong", m.line);
    set(*node, "diffuse_reflectance", color(m.diffuse, files, report), m.diffuse.line);
    set(*node, "specular_reflectance", color(m.specular, files, report), m.specular.line);
    set(*node, "exponent", m.exponent.numbers[0], m.exponent.line);
  } else if (m.illum == 4 || m.illum == 6 || m.illum == 7 || m.illum == 9) {
    node = &add(PluginKind::bsdf, "dielectric", m.line);
  } else if (m.illum == 5 || m.illum == 8) {
    node = &add(PluginKind::bsdf, "conductor", m.line);
    set(*node, "material", std::string("Al"), m.line);
  } else {
    node = &add(PluginKind::bsdf, "diffuse", m.line);
    set(*node, "reflectance", color(m.diffuse, files, report), m.diffuse.line);
  }
  const auto wrap = [&](const char* type, int line) {
    Node& outer = add(PluginKind::bsdf, type, line);
    set(outer, "", static_cast<const Node*>(node), m.line);
    node = &outer;
  };
  if (m.bump.line > 0) {
    const PropertyValue height = image(m.bump, true, files, report);
    // Black is flat.
    if (std::holds_alternative<const Node*>(height)) {
      wrap("bumpmap", m.bump.line);
      set(*node, "", height, m.bump.line);
    }
  }
  if (m.opacity.line > 0) {
    wrap("mask", m.opacity.line);
    set(*node, "opacity",
        m.opacity.image.empty() ? PropertyValue(m.opacity.numbers[0])
                                : image(m.opacity, false, files, report),
        m.opacity.line);
  }
  node->id = m.name;
  return node;
}

}  // namespace duet
