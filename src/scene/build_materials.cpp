// Builds materials from their descriptions.
#include "scene/builder.h"

namespace duet {

const Material* SceneBuilder::material(MaterialId id) {
  const size_t index = size_t(id);
  return once(materials_[index], [&]() -> const Material* {
    const MaterialDescription& d = description_.materials[index];
    auto made = d.model.build(*this, d.where);
    if (!made) return nullptr;
    if (const int n = made->component_count(); n > Bsdf::kMaxComponents) {
      diagnostics_.error(d.where, "{} BSDFs are mixed here; at most {} can be", n,
                         Bsdf::kMaxComponents);
      return nullptr;
    }
    const CoverCount covers = made->cover_count();
    if (covers.deep > kMaxCovers) {
      diagnostics_.error(d.where,
                         "{} bump maps, normal maps and coatings lie over each other here; "
                         "at most {} can",
                         covers.deep, kMaxCovers);
      return nullptr;
    }
    if (covers.total > Bsdf::kMaxCoversInAll) {
      diagnostics_.error(d.where,
                         "{} bump maps, normal maps and coatings are mixed here; at most {} can be",
                         covers.total, Bsdf::kMaxCoversInAll);
      return nullptr;
    }
    materials_[index].index = uint32_t(scene_->materials.size());
    scene_->materials.emplace_back(made.release());
    return scene_->materials.back().get();
  });
}

RoughnessOptions SceneBuilder::roughness(const Roughness& r) {
  const FloatSlot alpha_u = slot(r.alpha_u);
  return {r.distribution, alpha_u, slot(r.alpha_v), r.sample_visible};
}

}  // namespace duet
