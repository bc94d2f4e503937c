#include "scene/bsdfs/diffuse.h"

#include "materials/materials.h"
#include "scene/builder.h"

namespace duet {

MaterialPointer DiffuseMaterial::build(SceneBuilder& b, const SourceLocation&) const {
  return std::make_unique<Diffuse>(b.slot(reflectance));
}

MaterialPointer RoughDiffuseMaterial::build(SceneBuilder& b, const SourceLocation&) const {
  return std::make_unique<RoughDiffuse>(b.slot(reflectance), b.slot(alpha), use_fast_approx);
}

MaterialPointer DiffuseTransmitterMaterial::build(SceneBuilder& b, const SourceLocation&) const {
  return std::make_unique<DiffuseTransmitter>(b.slot(transmittance));
}

}  // namespace duet
