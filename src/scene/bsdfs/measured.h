// Measured reflection.
#pragma once

#include "materials/measured_table.h"
#include "scene/material_model.h"

namespace duet {

struct MeasuredMaterial {
  std::shared_ptr<const MeasuredTable> table;
  std::string file;  ///< that it was read from; the table is what counts

  static constexpr auto fields() {
    using M = MeasuredMaterial;
    return FieldList(field(&M::table), field(&M::file, Parameter{.name = "filename",
                                                                 .type = ParameterType::file,
                                                                 .note = "a .bsdf file in RGB",
                                                                 .required = true})
                                           .shown(" ")
                                           .not_compared()
                                           .read_by_plugin());
  }
  static constexpr const char* name() { return "measured"; }
  Scattering scattering() const { return {.rough_reflection = true}; }
  MaterialPointer build(SceneBuilder& b, const SourceLocation& where) const;
};

}  // namespace duet
