#include <algorithm>

#include "scene/description.h"

#include "scene/features.h"

namespace duet {

namespace {

/// Whether light can pass through the material.
bool transmits(const SceneDescription& d, MaterialId id) {
  return std::visit(
      [&](const auto& m) -> bool {
        using M = std::decay_t<decltype(m)>;
        if constexpr (requires { m.nested; })
          return std::is_same_v<M, MaskMaterial> || transmits(d, m.nested);
        else if constexpr (requires { m.first; })
          return transmits(d, m.first) || transmits(d, m.second);
        else if constexpr (requires { m.parts; })
          return std::any_of(m.parts.begin(), m.parts.end(),
                             [&](const auto& part) { return transmits(d, part.second); });
        else if constexpr (std::is_same_v<M, PrincipledMaterial>)
          return m.spec_trans != FloatInput(0.0);
        else
          return std::is_same_v<M, DielectricMaterial> ||
                 std::is_same_v<M, ThinDielectricMaterial> || std::is_same_v<M, NullMaterial> ||
                 std::is_same_v<M, PrincipledThinMaterial> ||
                 std::is_same_v<M, DiffuseTransmitterMaterial> || std::is_same_v<M, HairMaterial> ||
                 std::is_same_v<M, FilterMaterial> || std::is_same_v<M, ThinLayerMaterial>;
      },
      d.materials[size_t(id)].model);
}

}  // namespace

bool is_one_way(const SceneDescription& scene, const ShapeDescription& s) {
  const auto* tubes = std::get_if<CurvesShape>(&s.geometry);
  return tubes && tubes->curves->outside_only && transmits(scene, s.material);
}

}  // namespace duet
