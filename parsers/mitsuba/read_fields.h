// Reads what a plugin's description states as its fields.
#pragma once

#include "mitsuba/scene_reader.h"

namespace duet {

/// Index of the inside over that of the outside; an error for a rough interface without difference.
double relative_index(SceneReader& s, Properties& p);
/// The roughness of an interface; zero becomes small, and what is negative is an error.
Roughness read_roughness(SceneReader& s, Properties& p);
/// The BSDFs that are nested in the plugin; none, after an error, unless there are from `least` to
/// `most` of them.
std::vector<MaterialId> nested_bsdfs(SceneReader& s, Properties& p, size_t least, size_t most);

/// The same for phase functions: there must be `count`.
std::vector<PhaseId> nested_phases(SceneReader& s, Properties& p, size_t count);

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
    if (facts.parameters.empty() || !p_.knows(facts.name())) return;
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
  using Facts = FieldFacts;
  void read(const Facts& f, bool& value) { value = p_.boolean(f.name()); }
  void read(const Facts& f, int& value) { value = p_.integer(f.name()); }
  void read(const Facts& f, uint64_t& value) { value = uint64_t(p_.integer(f.name())); }
  void read(const Facts& f, double& value);
  void read(const Facts& f, std::optional<double>& v) { v = p_.optional_number(f.name()); }
  void read(const Facts& f, std::string& value);
  void read(const Facts& f, ColorInput& value) { value = s_.color(p_, f.name()); }
  void read(const Facts& f, std::optional<ColorInput>& value);
  void read(const Facts& f, FloatInput& value);
  void read(const Facts& f, Spectrum& value) { value = s_.constant_color(p_, f.name()); }
  void read(const Facts& f, ColorVolume& value) { value = s_.color_volume(p_, f.name()); }
  void read(const Facts& f, FloatVolume& value) { value = s_.float_volume(p_, f.name()); }
  void read(const Facts& f, UvTransform& value);
  void read(const Facts& f, Matrix4& value) { value = p_.transform(f.name()); }
  void read(const Facts& f, std::optional<TextureId>& v) { v = s_.texture(p_, f.name()); }
  void read(const Facts&, Roughness& value) { value = read_roughness(s_, p_); }
  void read(const Facts&, std::optional<Roughness>& value);
  template <class M>
  void read(const Facts&, M&) {}  // by the plugin
  void read_nested(TextureId& value);

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

/// The fields that are nested BSDFs or phase functions, in their order; false after an error.
template <class T>
bool read_nested(SceneReader& s, Properties& p, T& description) {
  std::vector<MaterialId*> bsdfs;
  std::vector<PhaseId*> phases;
  size_t least = 0;
  for_each_field(description, [&]<class M>(const FieldFacts& facts, M& value) {
    if constexpr (std::is_same_v<M, PhaseId>) phases.push_back(&value);
    if constexpr (std::is_same_v<M, MaterialId>) {
      bsdfs.push_back(&value);
      least += !facts.optional;
    }
  });
  const auto assign = [](const auto& fields, const auto& ids) {
    for (size_t i = 0; i < fields.size() && !ids.empty(); ++i)
      *fields[i] = ids[std::min(i, ids.size() - 1)];
    return fields.empty() || !ids.empty();
  };
  if (!phases.empty()) return assign(phases, nested_phases(s, p, phases.size()));
  if (bsdfs.empty()) return true;
  return assign(bsdfs, nested_bsdfs(s, p, least, bsdfs.size()));
}

/// Reads what its fields say into a plugin of a kind whose description holds one as its `model`.
/// `kCheck`, if there is one, looks at the values and reports, or changes, what they cannot be; it
/// may return false after an error.
template <class T, auto kCheck = nullptr, class Description>
void read_model(SceneReader& s, Properties& p, Description& out) {
  T model;
  if (!read_values(s, p, model)) return;
  if constexpr (requires { bool(kCheck(s, p, model)); }) {
    if (!kCheck(s, p, model)) return;
  } else if constexpr (requires { kCheck(s, p, model); }) {
    kCheck(s, p, model);
  }
  if (read_nested(s, p, model)) out.model = std::move(model);
}

}  // namespace duet
