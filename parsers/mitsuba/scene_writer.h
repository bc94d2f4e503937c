// The parts of writing a description; use writer.h.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "scene/description.h"
#include "scene/texture_uses.h"
#include "xml/xml_printer.h"

namespace duet {

/// Collects text and losses. Textures, materials and groups come before what refers to them.
class SceneWriter {
 public:
  explicit SceneWriter(const SceneDescription& description)
      : d_(description), texture_uses_(texture_uses(description)) {}
  void write();
  const std::string& text() const { return out_.text(); }
  const std::vector<std::string>& losses() const { return losses_; }

 private:
  void name_things();
  void material(const MaterialDescription& m, const std::string& id);
  std::string unique_id(const std::string& wanted, const std::string& otherwise);
  void lose(std::string what);

  void texture(size_t index);
  /// The texture; a checkerboard that yields numbers as Mitsuba 3, which exchanges them, has to say
  /// it.
  TextureDescription exchanged(size_t index);

  // write_fields.cpp: the fields of a plugin; what has no name is nested or not written.
  void fields(const MaterialModel& model);
  template <HasFields T>
  void fields(const T& description);
  /// What is open is the plugin of that description: its fields and what is lost of it.
  template <HasFields T>
  void plugin(std::string_view tag, const T& description);
  void color(std::string_view name, const ColorInput& input);
  void number(std::string_view name, const FloatInput& input);
  void field(const FieldFacts& facts, const Choice& choice);
  void field(const FieldFacts& facts, bool value);
  void field(const FieldFacts& facts, double value);
  void field(const FieldFacts& facts, const std::optional<double>& value);
  void field(const FieldFacts& facts, const std::string& value);
  void field(const FieldFacts& facts, const ColorInput& value);
  void field(const FieldFacts& facts, const std::optional<ColorInput>& value);
  void field(const FieldFacts& facts, const FloatInput& value);
  void field(const FieldFacts& facts, int value);
  void field(const FieldFacts& facts, const Spectrum& value);
  void field(const FieldFacts& facts, const ColorVolume& value);
  void field(const FieldFacts& facts, const UvTransform& value);
  void field(const FieldFacts& facts, const Matrix4& value);
  void field(const FieldFacts& facts, TextureId value);
  void field(const FieldFacts& facts, const Roughness& value);
  void field(const FieldFacts& facts, const std::optional<Roughness>& value);
  void field(const FieldFacts& facts, MaterialId value);
  void field(const FieldFacts& facts, const MaterialShares& value);
  void field(const FieldFacts&, const std::shared_ptr<const MeasuredTable>&) {}

  // write_media.cpp
  void volume(std::string_view name, VolumeId id);
  void volume(std::string_view name, const ColorVolume& input);
  void phase(PhaseId id);
  void medium(const MediumDescription& m, const std::string& id);

  // write_integrators.cpp
  void integrator(const IntegratorDescription& i);
  void write_limits(const PathLimits& m);
  void write_path(std::string_view type, const PathLimits& m);
  void write_method(const PathIntegratorDescription& m);
  void write_method(const VolumePathIntegratorDescription& m);
  void write_method(const DirectIntegratorDescription& m);
  void write_method(const DepthIntegratorDescription& m);
  void write_method(const OcclusionIntegratorDescription& m);
  void write_method(const BidirectionalIntegratorDescription& m);
  void write_method(const AutoIntegratorDescription& m);

  // scene_writer.cpp
  void sensor(const SensorDescription& s);
  /// What the sensor is, without its film and sampler.
  void view(const SensorDescription& s);
  void film(const FilmDescription& f);
  void filter(const FilterDescription& f);
  void fov(double degrees, FovAxis axis);
  void light(const LightDescription& l);
  void sampling_weight(double weight);

  // write_shapes.cpp
  void shape(const ShapeDescription& s, const std::string& id, std::string_view name = {});
  /// The irradiance meters on a shape of the scene; none on others.
  void meters(const ShapeDescription& s);
  void mesh(const MeshShape& m);
  void height_field(const HeightFieldShape& f);

  const std::string& texture_id(TextureId id) const { return texture_ids_[size_t(id)]; }
  const std::string& medium_id(MediumId id) const { return medium_ids_[size_t(id)]; }
  const std::string& material_id(MaterialId id) const { return material_ids_[size_t(id)]; }

  const SceneDescription& d_;
  const std::vector<TextureUse> texture_uses_;
  XmlPrinter out_;
  std::vector<std::string> losses_;
  std::set<std::string> ids_;
  std::vector<std::string> texture_ids_, material_ids_, medium_ids_, group_ids_;
};

template <HasFields T>
void SceneWriter::fields(const T& description) {
  for_each_field(description, [&]<class M>(const FieldFacts& facts, const M& value) {
    if (!facts.given || facts.unwritten || facts.initial) return;
    if constexpr (std::is_enum_v<M> && !kIsId<M>)
      field(facts, Choice{size_t(value)});
    else
      field(facts, value);
  });
}

template <HasFields T>
void SceneWriter::plugin(std::string_view tag, const T& description) {
  fields(description);
  if constexpr (requires { T::kOnlyIn0x; })
    lose(fmt::format("the {} \"{}\" does not exist in Mitsuba 3", tag, description.name()));
  if constexpr (requires { description.losses(); })
    for (std::string& loss : description.losses()) lose(std::move(loss));
}

}  // namespace duet
