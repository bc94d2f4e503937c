#include "materials/diffuse.h"

#include "materials/materials.h"

namespace duet {

Diffuse::Diffuse(const ColorSlot& reflectance) : reflectance_(reflectance) {
  if (reflectance.is_constant()) set_constant(model({}));
}

SurfaceNeeds Diffuse::needs() const {
  return {.uv = reflectance_.needs_uv()};
}

}  // namespace duet
