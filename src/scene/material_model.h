// A BSDF of a scene description, of any plugin.
#pragma once

#include <functional>

#include "scene/model.h"
#include "scene/scattering.h"

namespace duet {

class Material;
class SceneBuilder;
struct SceneDescription;

/// Owns a material of a class that is not known here.
struct MaterialDeleter {
  MaterialDeleter() = default;
  template <class M>
  MaterialDeleter(const std::default_delete<M>&) {}
  void operator()(Material* material) const;
};
using MaterialPointer = std::unique_ptr<Material, MaterialDeleter>;

/// What a BSDF's struct must have besides its fields and its name. After an error that build() has
/// reported to the builder it returns null.
template <class T>
concept BsdfData = PluginData<T> &&
    requires(const T& bsdf, SceneBuilder& builder, const SourceLocation& where) {
  { bsdf.scattering() } -> std::same_as<Scattering>;
  { bsdf.build(builder, where) } -> std::same_as<MaterialPointer>;
};

/// What a BSDF is asked for. It may also have a function loss(): a sentence about what Mitsuba 3
/// has no way to say of it, or nothing.
struct BsdfOperations {
  Scattering (*scattering)(const void*);
  MaterialPointer (*build)(const void*, SceneBuilder&, const SourceLocation&);
  std::string (*loss)(const void*);

  template <BsdfData T>
  static constexpr BsdfOperations of() {
    return {[](const void* t) { return static_cast<const T*>(t)->scattering(); },
            [](const void* t, SceneBuilder& builder, const SourceLocation& where) {
              return static_cast<const T*>(t)->build(builder, where);
            },
            [](const void* t) {
              if constexpr (requires(const T& bsdf) { bsdf.loss(); })
                return std::string(static_cast<const T*>(t)->loss());
              else
                return (void)t, std::string();
            }};
  }
};

class MaterialModel : public Model<BsdfOperations> {
 public:
  using Model::Model;

  /// How it scatters light itself; what is nested in it does not count.
  Scattering scattering() const { return operations().scattering(data()); }
  MaterialPointer build(SceneBuilder& builder, const SourceLocation& where) const {
    return operations().build(data(), builder, where);
  }
  std::string loss() const { return operations().loss(data()); }
  /// The materials that are nested in it, in their order.
  std::vector<MaterialId> nested() const;
};

/// Whether the material, or one of those that are nested in it, is such a one.
bool holds(const SceneDescription& scene, MaterialId id,
           const std::function<bool(const MaterialModel&)>& is_such);
/// Whether light can pass to the other side of the material, through it or what is nested in it.
bool transmits(const SceneDescription& scene, MaterialId id);

}  // namespace duet
