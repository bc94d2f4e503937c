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
  if (reflectance) o.reflectance = b.slot(*reflectance);
  if (sigma_a) o.absorption = b.slot(*sigma_a);
  o.absorption_scale = float(scale);
  o.eumelanin = b.slot(eumelanin);
  o.pheomelanin = b.slot(pheomelanin);
  return std::make_unique<HairFibre>(o);
}

const char* HairMaterial::loss() const {
  if (reflectance) return "the BSDF \"hair\" has no \"reflectance\" in Mitsuba 3";
  const bool numbers =
      std::holds_alternative<double>(eumelanin) && std::holds_alternative<double>(pheomelanin);
  return sigma_a || numbers ? "" : "the pigments of \"hair\" are no textures in Mitsuba 3";
}

}  // namespace duet
