// Words for the parts of a scene description, one line each.
#pragma once

#include <string>

#include "scene/description.h"

namespace duet {

/// Uses the plugin names of Mitsuba 3 and the names that things have in the file.
class DescriptionText {
 public:
  /// The scene must outlive this.
  explicit DescriptionText(const SceneDescription& scene) : scene_(scene) {}

  std::string name(MaterialId id) const;
  std::string name(MediumId id) const;
  /// With all that is nested in it.
  std::string material(MaterialId id) const;
  std::string medium(const MediumDescription& medium) const;
  std::string texture(const TextureDescription& texture) const;
  /// The plugin: obj, sphere, instance …
  std::string shape_kind(const ShapeDescription& shape) const;
  std::string shape(const ShapeDescription& shape) const;
  std::string area_light(const ShapeDescription& shape) const;
  std::string light(const LightDescription& light) const;
  std::string sensor(const SensorDescription& sensor) const;
  std::string film(const FilmDescription& film) const;

  std::string input(const ColorInput& input) const;
  std::string input(const FloatInput& input) const;
  std::string input(const ColorVolume& input) const;

 private:
  std::string texture_name(TextureId id) const;
  std::string phase(PhaseId id) const;
  const SceneDescription& scene_;
};

}  // namespace duet
