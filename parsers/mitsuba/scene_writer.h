// The parts of writing a description; use writer.h.
#pragma once

#include <string>
#include <vector>

#include "scene/description.h"
#include "scene/texture_uses.h"
#include "values/writing.h"
#include "xml/xml_printer.h"

namespace duet {

/// Collects text and losses. Textures, materials and groups come before what refers to them.
class SceneWriter {
 public:
  explicit SceneWriter(const SceneDescription& description)
      : d_(description), texture_uses_(texture_uses(description)) {}
  void write();
  const std::string& text() const { return out_.text(); }
  const std::vector<std::string>& losses() const { return losses_.list(); }

 private:
  void name_things();
  void material(const MaterialDescription& m, const std::string& id);
  std::string unique_id(const std::string& wanted, const std::string& otherwise);
  void lose(std::string what) { losses_.add(std::move(what)); }

  void texture(size_t index);
  /// The texture; a checkerboard that yields numbers as Mitsuba 3, which exchanges them, has to say
  /// it.
  TextureDescription exchanged(size_t index);

  // write_fields.cpp: the fields of a plugin; what has no name is nested or not written.
  template <class T>
  void fields(const T& description);
  template <class M>
  void one_field(const FieldFacts& facts, const M& value);
  template <class M>
  void one_field(const FieldFacts& facts, const Boxed<M>& value) {
    if (value) one_field(facts, *value);
  }
  /// What is open is the plugin of that description: its fields and what is lost of it.
  template <class T>
  void plugin(std::string_view tag, const T& description);
  void color(std::string_view name, const ColorInput& input);
  void number(std::string_view name, const FloatInput& input);
  using Facts = FieldFacts;
  void field(const Facts& f, const Choice& c) { out_.string(f.name(), f.words[c.index]); }
  void field(const Facts& f, bool value) { out_.boolean(f.name(), value); }
  void field(const Facts& f, int value) { out_.integer(f.name(), value); }
  void field(const Facts& f, uint64_t value) { out_.integer(f.name(), int64_t(value)); }
  void field(const Facts& f, double value);
  void field(const Facts& f, const std::string& value) { out_.string(f.name(), value); }
  void field(const Facts& f, const ColorInput& value) { color(f.name(), value); }
  void field(const Facts& f, const FloatInput& value);
  void field(const Facts& f, const Spectrum& value) { color(f.name(), ColorInput(value)); }
  void field(const Facts& f, const ColorVolume& value) { volume(f.name(), value); }
  void field(const Facts& f, const FloatVolume& value);
  void field(const Facts& f, const std::variant<std::array<double, 6>, VolumeId>& value);
  void field(const Facts& f, const std::vector<double>& value);
  void field(const Facts& f, const Matrix4& value) { out_.transform(f.name(), value); }
  void field(const Facts& f, const std::array<double, 3>& value) { out_.point(f.name(), value); }
  /// Two parameters, or one that is a list.
  void field(const Facts& f, const std::array<double, 2>& value);
  void field(const Facts& f, const CropWindow& value);
  void field(const Facts& f, const FilterDescription& value);
  void field(const Facts& f, const UvTransform& value);
  void field(const Facts&, PhaseId value) { phase(value); }
  void field(const Facts& f, TextureId value) { out_.reference(f.name(), texture_id(value)); }
  void field(const Facts& f, const Roughness& value);
  void field(const Facts&, MaterialId value) { out_.reference({}, material_id(value)); }
  void field(const Facts& f, const MaterialShares& value);
  /// What may be absent.
  template <class M>
  void field(const Facts& f, const std::optional<M>& value) {
    if (value) one_field(f, *value);
  }
  /// What has no form in a file.
  template <class T>
  void field(const Facts& f, const T&) {
    lose(fmt::format("the parameter \"{}\" is missing", f.name()));
  }

  void volume(std::string_view name, VolumeId id);
  void volume(std::string_view name, const ColorVolume& input);
  void phase(PhaseId id);
  void medium(const MediumDescription& m, const std::string& id);

  // scene_writer.cpp
  void integrator(const IntegratorDescription& i);
  void sensor(const SensorDescription& s);
  /// Opens what the sensor is, without its film and sampler.
  void view(const SensorDescription& s);
  void light(const LightDescription& l);

  // write_shapes.cpp
  void shape(const ShapeDescription& s, const std::string& id, std::string_view name = {});
  /// The irradiance meters on a shape of the scene; none on others.
  void meters(const ShapeDescription& s);
  void mesh(const MeshShape& m);

  const std::string& texture_id(TextureId id) const { return texture_ids_[size_t(id)]; }
  const std::string& medium_id(MediumId id) const { return medium_ids_[size_t(id)]; }
  const std::string& material_id(MaterialId id) const { return material_ids_[size_t(id)]; }

  const SceneDescription& d_;
  const std::vector<TextureUse> texture_uses_;
  XmlPrinter out_;
  Losses losses_;
  UniqueNames ids_;
  std::vector<std::string> texture_ids_, material_ids_, medium_ids_, group_ids_;
};

template <class M>
void SceneWriter::one_field(const FieldFacts& facts, const M& value) {
  constexpr bool nests = kIsId<M> || std::is_same_v<M, FilterDescription> ||
                         std::is_same_v<M, ColorInput> || std::is_same_v<M, FloatInput>;
  if constexpr (!nests)
    if (facts.name().empty()) return;
  if constexpr (std::is_enum_v<M> && !kIsId<M>)
    field(facts, Choice{size_t(value)});
  else
    field(facts, value);
}

template <class T>
void SceneWriter::fields(const T& description) {
  for_each_field(description, [&](const FieldFacts& facts, const auto& value) {
    if (facts.given && !facts.unwritten && !(facts.terse && facts.initial)) one_field(facts, value);
  });
}

template <class T>
void SceneWriter::plugin(std::string_view tag, const T& description) {
  fields(description);
  if constexpr (requires { T::kOnlyIn0x; })
    lose(fmt::format("the {} \"{}\" does not exist in Mitsuba 3", tag, description.name()));
  if constexpr (requires { description.losses(); })
    for (std::string& loss : description.losses()) lose(std::move(loss));
}

}  // namespace duet
