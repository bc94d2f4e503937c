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

  std::string value_text(double value) const;
  std::string value_text(const Spectrum& value) const;
  const std::string& value_text(const std::string& value) const { return value; }
  std::string value_text(const ColorInput& value) const { return input(value); }
  std::string value_text(const FloatInput& value) const { return input(value); }
  std::string value_text(const ColorVolume& value) const { return input(value); }
  /// The fields that are shown, each after its prefix.
  template <class T>
  std::string shown_fields(const T& description) const {
    std::string line;
    for_each_field(description, [&]<class M>(const FieldFacts& facts, const M& value) {
      if (facts.shown.empty() || !facts.given) return;
      if constexpr (std::is_same_v<M, bool>)
        line.append(value ? facts.shown : std::string_view());
      else if constexpr (requires { value_text(value); })
        line.append(facts.shown).append(value_text(value));
    });
    return line;
  }

  const SceneDescription& scene_;
};

}  // namespace duet
