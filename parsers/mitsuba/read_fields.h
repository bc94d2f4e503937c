// Reads what a plugin's description states as its fields.
#pragma once

#include "mitsuba/scene_reader.h"

namespace duet {

/// Reads one field after the other, by the parameters that spell it. Those that the plugin does not
/// have, and those that its own reader finds, are left as they are.
class FieldReader {
 public:
  FieldReader(SceneReader& scene, Properties& properties) : s_(scene), p_(properties) {}

  template <class M>
  void operator()(const FieldFacts& facts, M& value) {
    if (facts.read_by_plugin || facts.parameters.empty()) return;
    if constexpr (std::is_same_v<M, MaterialId> || std::is_same_v<M, MaterialShares>)
      return;  // read_nested()
    else if constexpr (std::is_enum_v<M>)
      value = M(p_.choice(facts.name(), facts.words));
    else
      read(facts, value);
  }

 private:
  void read(const FieldFacts& facts, bool& value);
  void read(const FieldFacts& facts, double& value);
  void read(const FieldFacts& facts, std::optional<double>& value);
  void read(const FieldFacts& facts, std::string& value);
  void read(const FieldFacts& facts, ColorInput& value);
  void read(const FieldFacts& facts, std::optional<ColorInput>& value);
  void read(const FieldFacts& facts, FloatInput& value);
  void read(const FieldFacts& facts, Roughness& value);
  void read(const FieldFacts& facts, std::optional<Roughness>& value);
  void read(const FieldFacts&, std::shared_ptr<const MeasuredTable>&) {}  // by the plugin

  SceneReader& s_;
  Properties& p_;
};

/// The fields that are no nested plugins.
template <class T>
void read_values(SceneReader& s, Properties& p, T& description) {
  for_each_field(description, FieldReader(s, p));
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
