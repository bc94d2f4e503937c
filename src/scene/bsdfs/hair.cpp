#include "scene/bsdfs/hair.h"

#include <algorithm>

#include "materials/special_materials.h"
#include "scene/builder.h"

namespace duet {

MaterialPointer HairMaterial::build(SceneBuilder& b, const SourceLocation&) const {
  HairOptions o;
  o.longitudinal_roughness = b.slot(longitudinal_roughness);
  o.azimuthal_roughness = b.slot(azimuthal_roughness);
  o.scale_tilt = b.slot(scale_tilt);
  o.eta = b.slot(eta);
  if (reflectance) o.reflectance = b.slot(*reflectance);
  if (sigma_a) o.absorption = b.slot(*sigma_a);
  o.absorption_scale = float(scale);
  o.eumelanin = b.slot(eumelanin);
  o.pheomelanin = b.slot(pheomelanin);
  return std::make_unique<HairFibre>(o);
}

const char* HairMaterial::loss() const {
  if (reflectance) return "the BSDF \"hair\" has no \"reflectance\" in Mitsuba 3";
  const auto numbers = [](std::initializer_list<const FloatInput*> inputs) {
    return std::ranges::all_of(inputs, [](auto* i) { return std::holds_alternative<double>(*i); });
  };
  if (!sigma_a && !numbers({&eumelanin, &pheomelanin}))
    return "the pigments of \"hair\" are no textures in Mitsuba 3";
  if (!numbers({&longitudinal_roughness, &azimuthal_roughness, &scale_tilt, &eta}))
    return "roughness, tilt and index of \"hair\" are no textures in Mitsuba 3";
  return "";
}

}  // namespace duet
