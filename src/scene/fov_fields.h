// Fields of view by angle, or by the focal length of a lens.
#pragma once

#include "math/fov.h"
#include "scene/field.h"

namespace duet {

inline constexpr std::string_view kFovAxes[] = {"x", "y", "diagonal", "smaller", "larger"};

/// Two fields, which their plugin reads together.
template <class T>
constexpr auto fov_fields(double T::*fov, FovAxis T::*axis, std::string_view note) {
  using enum ParameterType;
  return FieldList(
      field(fov, Parameter{"fov", number, "", note, NumberRange::degrees})
          .read_by_plugin()
          .shown(", fov "),
      field(axis, Parameter{"fov_axis", string, kInitial, "x, y, diagonal, smaller or larger"},
            Parameter{"focal_length", string, "50mm", "of a lens before 36 mm × 24 mm film"})
          .words(kFovAxes)
          .read_by_plugin()
          .shown(" along "));
}

}  // namespace duet
