#include "scene/bsdfs/hair.h"

#include "materials/special_materials.h"
#include "math/angles.h"
#include "scene/builder.h"

namespace duet {

MaterialPointer HairMaterial::build(SceneBuilder& b, const SourceLocation&) const {
  HairOptions o;
  o.longitudinal_roughness = float(longitudinal_roughness);
  o.azimuthal_roughness = float(azimuthal_roughness);
  o.scale_tilt = float(scale_tilt * kRadians);
  o.eta = float(eta);
  o.absorption =
      sigma_a ? b.slot(*sigma_a) : ColorSlot{hair_absorption(float(eumelanin), float(pheomelanin))};
  if (sigma_a) o.absorption_scale = float(scale);
  return std::make_unique<HairFibre>(o);
}

}  // namespace duet
