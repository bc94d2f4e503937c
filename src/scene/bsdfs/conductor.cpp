#include "scene/bsdfs/conductor.h"

#include "materials/materials.h"
#include "scene/builder.h"

namespace duet {

MaterialPointer ConductorMaterial::build(SceneBuilder& b, const SourceLocation&) const {
  const ConductorOptions o{b.slot(eta), b.slot(k), b.slot(specular_reflectance)};
  if (roughness) return std::make_unique<RoughConductor>(o, b.roughness(*roughness));
  return std::make_unique<Conductor>(o);
}

}  // namespace duet
