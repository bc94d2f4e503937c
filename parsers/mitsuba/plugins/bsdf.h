// Makes a plugin of the vocabulary from the description of a BSDF.
//
// What its fields say needs no code: bsdf<PhongMaterial>({.note = "Mitsuba 3 has none"}). A plugin
// that means more by its parameters has a function that reads it, with read_values() and
// read_nested().
#pragma once

#include "mitsuba/read_fields.h"
#include "mitsuba/vocabulary.h"

namespace duet::plugins {

using namespace parameter_words;

template <class T>
void read_bsdf(SceneReader& s, Properties& p, MaterialDescription& out) {
  T bsdf;
  read_values(s, p, bsdf);
  if (read_nested(s, p, bsdf)) out.model = std::move(bsdf);
}

/// The fields of T without the roughness that its interface may have.
template <class T>
constexpr auto smooth_fields() {
  return std::apply(
      [](const auto&... fields) {
        [[maybe_unused]] const auto unless_rough =
            []<class B, class M, size_t N>(const Field<B, M, N>& f) {
              if constexpr (std::is_same_v<M, std::optional<Roughness>>)
                return std::tuple();
              else
                return std::tuple(f);
            };
        return std::tuple_cat(unless_rough(fields)...);
      },
      T::fields());
}

template <class T>
inline constexpr auto kRoughParameters = joined_parameters(T::fields());
template <class T>
inline constexpr auto kSmoothParameters = joined_parameters(smooth_fields<T>());

/// What `row` leaves open follows from T: its name, its parameters and how it is read. Where the
/// interface may be rough, it is smooth.
template <class T>
Plugin bsdf(Plugin row = {}) {
  if (row.name.empty()) row.name = T{}.name();
  if (row.parameters.empty()) row.parameters = kSmoothParameters<T>;
  if (std::holds_alternative<std::monostate>(row.reader)) row.reader = &read_bsdf<T>;
  return row;
}

/// The same for the plugin with a rough interface, whose name must be given.
template <class T>
Plugin rough_bsdf(Plugin row) {
  if (row.parameters.empty()) row.parameters = kRoughParameters<T>;
  return bsdf<T>(row);
}

}  // namespace duet::plugins
