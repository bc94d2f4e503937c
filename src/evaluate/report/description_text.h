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
  std::string value_text(int value) const { return std::to_string(value); }
  std::string value_text(const Spectrum& value) const;
  const std::string& value_text(const std::string& value) const { return value; }
  std::string value_text(TextureId value) const { return texture_name(value); }
  std::string value_text(MediumId value) const { return name(value); }
  std::string value_text(const ColorInput& value) const { return input(value); }
  std::string value_text(const FloatInput& value) const { return input(value); }
  std::string value_text(const ColorVolume& value) const { return input(value); }
  template <size_t N>
  std::string value_text(const std::array<double, N>& value) const {
    return fmt::format("({:.4g})", fmt::join(value, ", "));
  }
  std::string value_text(const FilmResponse& value) const;
  std::string value_text(const SampleLimit& value) const { return value_text(value.most); }
  std::string value_text(const CropWindow& value) const;
  std::string value_text(const FilterDescription& value) const;
  std::string value_text(const std::vector<LensSurface>& value) const;
  std::string value_text(const std::vector<ShapeDescription>& value) const;
  template <HasFields T>
  std::string value_text(const T& value) const {
    return shown_fields(value);
  }
  /// Adds a field's prefix and its value, if there is one.
  template <class M>
  void show(std::string& line, const FieldFacts& facts, const M& value) const {
    if constexpr (std::is_same_v<M, bool>)
      line.append(value ? facts.shown : std::string_view());
    else if constexpr (std::is_same_v<M, Choice>)
      line.append(facts.shown).append(facts.words[value.index]);
    else if constexpr (std::is_enum_v<M> && !kIsId<M>)
      show(line, facts, Choice{size_t(value)});
    else if constexpr (requires { value_text(value); })
      line.append(facts.shown).append(value_text(value));
  }
  template <class M>
  void show(std::string& line, const FieldFacts& facts, const std::optional<M>& value) const {
    if (value) show(line, facts, *value);
  }
  static bool is_shown(const FieldFacts& facts) {
    return facts.given && !facts.shown.empty() && !(facts.shown_if_changed && facts.initial);
  }
  /// The fields that are shown, each after its prefix.
  template <class T>
  std::string shown_fields(const T& description) const {
    std::string line;
    for_each_field(description, [&](const FieldFacts& facts, const auto& value) {
      if (is_shown(facts)) show(line, facts, value);
    });
    return line;
  }

  const SceneDescription& scene_;
};

}  // namespace duet
