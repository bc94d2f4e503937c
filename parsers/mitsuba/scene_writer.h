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

  // write_textures.cpp
  void color(std::string_view name, const ColorInput& input);
  void number(std::string_view name, const FloatInput& input);
  void uv_transform(const UvTransform& uv);
  void texture(size_t index);
  void write_model(const BitmapTexture& t);
  void write_model(const CheckerboardTexture& t);
  void write_model(const MeshAttributeTexture& t);
  void write_model(const GridLinesTexture& t);
  void write_model(const WireframeTexture& t);
  void write_model(const CurvatureTexture& t);
  void write_model(const ScaledTextureDescription& t);
  void write_model(const VolumeTextureDescription& t);

  // write_fields.cpp: the fields of a plugin; what has no name is nested or not written.
  void fields(const MaterialModel& model);
  void field(const FieldFacts& facts, const Choice& choice);
  void field(const FieldFacts& facts, bool value);
  void field(const FieldFacts& facts, double value);
  void field(const FieldFacts& facts, const std::optional<double>& value);
  void field(const FieldFacts& facts, const std::string& value);
  void field(const FieldFacts& facts, const ColorInput& value);
  void field(const FieldFacts& facts, const std::optional<ColorInput>& value);
  void field(const FieldFacts& facts, const FloatInput& value);
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

}  // namespace duet
