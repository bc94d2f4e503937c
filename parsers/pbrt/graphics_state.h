// What holds for the directives of a pbrt file that come next.
#pragma once

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "math/transform.h"
#include "pbrt/parameter.h"
#include "scene/description.h"

namespace duet::pbrt {

/// What textures and materials are called. In v3 the names belong to the graphics state, in v4 to
/// the whole file.
struct NameTables {
  std::map<std::string, ColorInput, std::less<>> colors;
  std::map<std::string, FloatInput, std::less<>> numbers;
  std::map<std::string, MaterialId, std::less<>> materials;
  /// What those of v3 were made of, as GraphicsState::material_plugin.
  std::map<std::string, std::shared_ptr<const Plugin>, std::less<>> material_plugins;
};

/// What `Attribute` sets for plugins of a kind, latest first.
using Defaults = std::map<std::string, std::vector<Parameter>, std::less<>>;

struct GraphicsState {
  /// From object to world space when the motion begins and when it ends; before Camera, from world
  /// to camera space.
  std::array<Matrix4, 2> ctm;
  /// Which of the two are changed: one bit each.
  unsigned active = 3;
  bool reverse_orientation = false;
  uint8_t color_space = 0;
  MaterialId material{};
  /// In v3 what the material was made of, which shapes may change; null: the default.
  std::shared_ptr<const Plugin> material_plugin;
  std::shared_ptr<const Plugin> area_light;
  /// Media behind and before surfaces.
  std::optional<MediumId> inside, outside;
  /// Shared until somebody changes them; null: none.
  std::shared_ptr<const Defaults> defaults;
  std::shared_ptr<NameTables> names;
};

}  // namespace duet::pbrt
