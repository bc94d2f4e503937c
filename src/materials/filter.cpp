#include "materials/filter.h"

#include "materials/special_materials.h"

namespace duet {

Filter::Filter(const ColorSlot& transmittance, float scale, bool has_albedo)
    : transmittance_(transmittance), scale_(scale), has_albedo_(has_albedo) {
  if (transmittance.is_constant()) set_constant(model({}));
}

SurfaceNeeds Filter::needs() const {
  return {.uv = transmittance_.needs_uv()};
}

}  // namespace duet
