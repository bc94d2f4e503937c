// Reconstruction filters by their kinds, with the parameters that each has.
#pragma once

#include <string>
#include <vector>

#include "image/filter.h"
#include "scene/field.h"

namespace duet {

inline constexpr const char* kFilterNames[] = {"box",      "tent",       "gaussian",
                                               "mitchell", "catmullrom", "lanczos"};

template <FilterKind kKind>
struct FilterOf : FilterDescription {
  FilterOf() : FilterDescription{.kind = kKind, .radius = kKind == FilterKind::tent ? 1.0 : 0.5} {}
  explicit FilterOf(const FilterDescription& f) : FilterDescription(f) {}

  static constexpr auto fields() {
    using namespace parameter_words;
    using enum ParameterType;
    using F = FilterDescription;
    if constexpr (kKind == FilterKind::box)
      return FieldList(field(&F::radius, Parameter{"radius", number, kInitial, "", positive, v0})
                           .unwritten()
                           .shown(" of radius "));
    else if constexpr (kKind == FilterKind::tent)
      return FieldList(field(&F::radius, Parameter{"radius", number, kInitial, "", positive})
                           .shown(" of radius "));
    else if constexpr (kKind == FilterKind::gaussian)
      return FieldList(field(&F::stddev, Parameter{"stddev", number, kInitial, "", positive})
                           .shown(" of deviation "));
    else if constexpr (kKind == FilterKind::mitchell)
      return FieldList(
          field(&F::b, Parameter{.name = "B", .type = number, .preset = "(1/3)", .aliases = "b"})
              .shown(", B "),
          field(&F::c, Parameter{.name = "C", .type = number, .preset = "(1/3)", .aliases = "c"})
              .shown(", C "));
    else if constexpr (kKind == FilterKind::lanczos)
      return FieldList(
          field(&F::lobes, Parameter{"lobes", integer, kInitial, "", positive}).shown(", lobes "));
    else
      return FieldList();
  }
  static constexpr const char* name() { return kFilterNames[size_t(kKind)]; }
  std::vector<std::string> losses() const {
    std::vector<std::string> lost;
    if (kKind == FilterKind::box && radius != 0.5)
      lost.emplace_back("the radius of a box filter is missing");
    if (reach_x || reach_y) lost.emplace_back("the extent of a filter is missing");
    return lost;
  }
};

/// visit(FilterOf<kind>) with the filter.
template <class Visit>
void with_filter(const FilterDescription& f, Visit&& visit) {
  using enum FilterKind;
  switch (f.kind) {
    case box:
      return visit(FilterOf<box>(f));
    case tent:
      return visit(FilterOf<tent>(f));
    case gaussian:
      return visit(FilterOf<gaussian>(f));
    case mitchell:
      return visit(FilterOf<mitchell>(f));
    case catmullrom:
      return visit(FilterOf<catmullrom>(f));
    case lanczos:
      return visit(FilterOf<lanczos>(f));
  }
}

}  // namespace duet
