#include "materials/filter.h"

#include "materials/special_materials.h"

namespace duet {

Filter::Filter(const ColorSlot& transmittance, float scale)
    : transmittance_(transmittance), scale_(scale) {
  if (transmittance.is_constant()) set_constant(model({}));
}

SurfaceNeeds Filter::needs() const {
  return {.uv = transmittance_.needs_uv()};
}

}  // namespace duet
