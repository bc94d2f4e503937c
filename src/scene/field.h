// The fields of a description as data that code can walk.
//
// A struct of plain data states its fields once, in a static function `fields()` that returns a
// list of what field() makes:
//
//   struct Glow {
//     ColorInput radiance = Spectrum(1.0f);
//     double scale = 1;
//     static constexpr auto fields() {
//       using enum ParameterType;
//       using enum NumberRange;
//       return FieldList(
//           field(&Glow::radiance, Parameter{"radiance", emission, "1"}).shown(" "),
//           field(&Glow::scale, Parameter{"scale", number, "1", "", not_negative}));
//     }
//   };
//
// The rows of the vocabulary, reading, writing, the line of `info`, comparison, the content hash
// and the use of textures follow from them (model.h says how).
#pragma once

#include <array>
#include <memory>
#include <span>
#include <string_view>
#include <utility>

#include "scene/parameter.h"

namespace duet {

/// What is known of a field besides its value.
struct FieldFacts {
  /// How scene files spell it; most often one. A refractive index has two (inside, outside), the
  /// roughness of an interface up to five. None: files say it otherwise.
  std::span<const Parameter> parameters;
  /// What precedes the value in the line of `info`; empty: the value is not shown.
  std::string_view shown;
  /// Whether it is shown only where it is not the initial one of its struct.
  bool shown_if_changed = false;
  /// The words for the values of an enumeration.
  std::span<const std::string_view> words;
  /// Whether the value means anything, beside those of the other fields.
  bool given = true;
  /// Whether it counts in comparisons, and so in the content hash.
  bool compared = true;
  /// Whether the plugin's own reader finds the value.
  bool read_by_plugin = false;
  /// Of nested things: one that may be missing is the one before it.
  bool optional = false;
  /// Whether it names a file whose content is what it means.
  bool names_data = false;
  /// Whether Mitsuba 3 has no such parameter, so that the value is not written.
  bool unwritten = false;
  /// Whether the value is written only where it is not the initial one of its struct.
  bool terse = false;
  /// Whether it is the initial one; known of fields for which that matters.
  bool initial = false;

  /// As Mitsuba 3 calls it; empty without a name.
  std::string_view name() const {
    return parameters.empty() ? std::string_view() : parameters.front().name;
  }
  bool has_parameter(std::string_view name) const {
    for (const Parameter& p : parameters)
      if (p.name == name) return true;
    return false;
  }
};

/// A field of type M in a struct T, spelled by N parameters.
template <class T, class M, size_t N>
struct Field {
  M T::*member;
  std::array<Parameter, N> parameters;
  FieldFacts facts = {};
  bool (*given_if)(const T&) = nullptr;

  /// Shows the value in the line of `info`, after the text `prefix`.
  constexpr Field shown(std::string_view prefix) const {
    Field f = *this;
    f.facts.shown = prefix;
    return f;
  }
  /// The same, if the value is not the initial one of its struct.
  constexpr Field shown_if_changed(std::string_view prefix) const {
    Field f = shown(prefix);
    f.facts.shown_if_changed = true;
    return f;
  }
  /// The value means something only where `condition` holds.
  constexpr Field when(bool (*condition)(const T&)) const {
    Field f = *this;
    f.given_if = condition;
    return f;
  }
  /// The words for the values of an enumeration, which must live forever.
  constexpr Field words(std::span<const std::string_view> list) const {
    Field f = *this;
    f.facts.words = list;
    return f;
  }
  constexpr Field not_compared() const {
    Field f = *this;
    f.facts.compared = false;
    return f;
  }
  constexpr Field read_by_plugin() const {
    Field f = *this;
    f.facts.read_by_plugin = true;
    return f;
  }
  constexpr Field names_data() const {
    Field f = *this;
    f.facts.names_data = true;
    return f;
  }
  constexpr Field unwritten() const {
    Field f = *this;
    f.facts.unwritten = true;
    return f;
  }
  constexpr Field terse() const {
    Field f = *this;
    f.facts.terse = true;
    return f;
  }
  constexpr Field optional() const {
    Field f = *this;
    f.facts.optional = true;
    return f;
  }
};

template <class T, class M, class... Parameters>
constexpr Field<T, M, sizeof...(Parameters)> field(M T::*member, const Parameters&... parameters) {
  return {member, {parameters...}};
}

template <size_t I, class F>
struct FieldSlot {
  F field;
};

template <class Indices, class... F>
class FieldSlots;

template <size_t... I, class... F>
class FieldSlots<std::index_sequence<I...>, F...> : FieldSlot<I, F>... {
 public:
  constexpr explicit FieldSlots(const F&... fields) : FieldSlot<I, F>{fields}... {}

  /// visit(fields...), in their order.
  template <class Visit>
  constexpr auto apply(Visit&& visit) const {
    return visit(static_cast<const FieldSlot<I, F>&>(*this).field...);
  }
};

/// Fields of different types, one after the other. Every user of a description compiles its list,
/// and a std::tuple takes the compiler several times as long.
template <class... F>
struct FieldList : FieldSlots<std::index_sequence_for<F...>, F...> {
  using FieldSlots<std::index_sequence_for<F...>, F...>::FieldSlots;

  /// The same fields, whose values mean something only where `condition` holds.
  template <class Condition>
  constexpr FieldList when(Condition condition) const {
    return this->apply([&](const auto&... field) { return FieldList(field.when(condition)...); });
  }
};
template <class... F>
FieldList(const F&...) -> FieldList<F...>;

/// One list after the other.
template <class A, class B, class... More>
constexpr auto joined_fields(const A& first, const B& second, const More&... more) {
  const auto both = first.apply([&](const auto&... a) {
    return second.apply([&](const auto&... b) { return FieldList(a..., b...); });
  });
  if constexpr (sizeof...(More) > 0)
    return joined_fields(both, more...);
  else
    return both;
}

/// Fields that nothing is to be said of.
template <class... T, class... M>
constexpr auto plain_fields(M T::*... members) {
  return FieldList(field(members)...);
}

/// Plain data that states its fields.
template <class T>
concept HasFields = requires {
  T::fields();
};

/// The fields of T, where they stay.
template <HasFields T>
inline constexpr auto kFields = T::fields();

/// Whether two fields say the same. Shared data may be the same or have the same content.
template <class M>
bool same_value(const M& a, const M& b) {
  return a == b;
}
template <class M>
bool same_value(const std::shared_ptr<const M>& a, const std::shared_ptr<const M>& b) {
  return a == b || (a && b && *a == *b);
}

/// Calls visit(const FieldFacts&, value) with each field, in their order. `value` may be const.
template <class Value, class Visit>
requires HasFields<std::remove_const_t<Value>>
void for_each_field(Value& value, Visit&& visit) {
  using T = std::remove_const_t<Value>;
  const auto one = [&](const auto& field) {
    FieldFacts facts = field.facts;
    facts.parameters = field.parameters;
    if (field.given_if) facts.given = field.given_if(value);
    if (facts.terse || facts.shown_if_changed)
      facts.initial = same_value(value.*field.member, T{}.*field.member);
    visit(std::as_const(facts), value.*field.member);
  };
  kFields<T>.apply([&](const auto&... fields) { (one(fields), ...); });
}

template <HasFields T>
bool operator==(const T& a, const T& b) {
  const auto same = [&](const auto& field) {
    return !field.facts.compared || same_value(a.*field.member, b.*field.member);
  };
  return kFields<T>.apply([&](const auto&... fields) { return (same(fields) && ...); });
}

}  // namespace duet
