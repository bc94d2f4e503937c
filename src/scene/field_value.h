// The values that fields of plugins can have, for code that knows no plugin by name.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "scene/description_base.h"
#include "scene/field.h"
#include "scene/roughness.h"

namespace duet {

struct MeasuredTable;

/// The value of an enumeration; FieldFacts::words names them.
struct Choice {
  size_t index;
};
/// Several materials and the weight of each.
using MaterialShares = std::vector<std::pair<double, MaterialId>>;

using FieldValue =
    std::variant<Choice, const bool*, const double*, const std::optional<double>*,
                 const std::string*, const ColorInput*, const std::optional<ColorInput>*,
                 const FloatInput*, const Roughness*, const std::optional<Roughness>*,
                 const Spectrum*, const int*, const std::optional<TextureId>*, const MaterialId*,
                 const MaterialShares*, const std::shared_ptr<const MeasuredTable>*>;

/// Called with each field of something.
using FieldVisit = std::function<void(const FieldFacts&, const FieldValue&)>;

template <class M>
FieldValue field_value(const M& value) {
  if constexpr (std::is_enum_v<M> && !std::is_same_v<M, MaterialId>)
    return Choice{size_t(value)};
  else
    return &value;
}

/// `f(value)` with the value itself.
template <class F>
auto with_value(const FieldValue& value, F&& f) {
  return std::visit(
      [&](const auto& v) {
        if constexpr (std::is_same_v<std::decay_t<decltype(v)>, Choice>)
          return f(v);
        else
          return f(*v);
      },
      value);
}

}  // namespace duet
