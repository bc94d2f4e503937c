// Reads what a plugin's description states as its fields.
#pragma once

#include "mitsuba/scene_reader.h"

namespace duet {

/// Reads one field after the other, by the parameters that spell it. Those that the plugin does not
/// have, and those that its own reader finds, are left as they are. A texture that no parameter
/// names is nested.
class FieldReader {
 public:
  FieldReader(SceneReader& scene, Properties& properties) : s_(scene), p_(properties) {}

  template <class M>
  void operator()(const FieldFacts& facts, M& value) {
    if (facts.read_by_plugin) return;
    if constexpr (std::is_same_v<M, TextureId>) return read_nested(value);
    if (facts.parameters.empty() || !has(facts.name())) return;
    if constexpr (std::is_same_v<M, MaterialId> || std::is_same_v<M, MaterialShares>)
      return;  // duet::read_nested()
    else if constexpr (std::is_enum_v<M>)
      value = M(p_.choice(facts.name(), facts.words));
    else
      read(facts, value);
  }
  /// Whether all that must be nested is there and has no error.
  bool is_complete() const { return complete_; }

 private:
  bool has(std::string_view name) const {
    return find_parameter(p_.node().kind, *p_.node().plugin, name) != nullptr;
  }
  void read_nested(TextureId& value);
  void read(const FieldFacts& facts, bool& value);
  void read(const FieldFacts& facts, int& value);
  void read(const FieldFacts& facts, double& value);
  void read(const FieldFacts& facts, std::optional<double>& value);
  void read(const FieldFacts& facts, std::string& value);
  void read(const FieldFacts& facts, ColorInput& value);
  void read(const FieldFacts& facts, std::optional<ColorInput>& value);
  void read(const FieldFacts& facts, FloatInput& value);
  void read(const FieldFacts& facts, Spectrum& value);
  void read(const FieldFacts& facts, ColorVolume& value);
  void read(const FieldFacts& facts, UvTransform& value);
  void read(const FieldFacts& facts, Matrix4& value);
  void read(const FieldFacts& facts, std::optional<TextureId>& value);
  void read(const FieldFacts& facts, Roughness& value);
  void read(const FieldFacts& facts, std::optional<Roughness>& value);
  void read(const FieldFacts&, std::shared_ptr<const MeasuredTable>&) {}  // by the plugin

  SceneReader& s_;
  Properties& p_;
  bool complete_ = true;
};

/// The fields that are no nested BSDFs; false if a nested texture is missing.
template <class T>
bool read_values(SceneReader& s, Properties& p, T& description) {
  FieldReader reader(s, p);
  for_each_field(description, reader);
  return reader.is_complete();
}

/// Reads what its fields say into a plugin of a kind whose description holds one as its `model`.
template <class T, class Description>
void read_model(SceneReader& s, Properties& p, Description& out) {
  T model;
  if (read_values(s, p, model)) out.model = std::move(model);
}

/// Index of the inside over that of the outside; an error for a rough interface without difference.
double relative_index(SceneReader& s, Properties& p);
/// The roughness of an interface; zero becomes small, and what is negative is an error.
Roughness read_roughness(SceneReader& s, Properties& p);
/// The BSDFs that are nested in the plugin; none, after an error, unless there are from `least` to
/// `most` of them.
std::vector<MaterialId> nested_bsdfs(SceneReader& s, Properties& p, size_t least, size_t most);

/// The fields that are nested BSDFs, in their order; false after an error.
template <class T>
bool read_nested(SceneReader& s, Properties& p, T& bsdf) {
  std::vector<MaterialId*> fields;
  size_t least = 0;
  for_each_field(bsdf, [&](const FieldFacts& facts, auto& value) {
    if constexpr (std::is_same_v<decltype(value), MaterialId&>) {
      fields.push_back(&value);
      least += !facts.optional;
    }
  });
  if (fields.empty()) return true;
  const std::vector<MaterialId> ids = nested_bsdfs(s, p, least, fields.size());
  if (ids.empty()) return false;
  for (size_t i = 0; i < fields.size(); ++i) *fields[i] = ids[std::min(i, ids.size() - 1)];
  return true;
}

}  // namespace duet
