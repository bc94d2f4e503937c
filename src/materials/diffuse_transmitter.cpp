#include "materials/diffuse_transmitter.h"

#include "materials/materials.h"

namespace duet {

DiffuseTransmitter::DiffuseTransmitter(const ColorSlot& transmittance)
    : transmittance_(transmittance) {
  if (transmittance.is_constant()) set_constant(model({}));
}

SurfaceNeeds DiffuseTransmitter::needs() const {
  return {.uv = transmittance_.needs_uv()};
}

}  // namespace duet
