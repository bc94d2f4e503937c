// A light of a scene description that is no surface, of any plugin.
#pragma once

#include <concepts>
#include <memory>
#include <string>
#include <vector>

#include "scene/model.h"

namespace duet {

class Light;
class SceneBuilder;
struct LightDescription;
struct SceneFeatures;
using LightPointer = std::unique_ptr<Light>;

/// What of a light's transform says where it is.
enum class LightPose { none, place, direction, both };

/// What the struct of a light must have besides its fields and its name. It may also have kPose,
/// kIsEnvironment and losses(). After an error that build() has reported it returns null.
template <class T>
concept LightData = PluginData<T> &&
    requires(const T& light, SceneBuilder& builder, const LightDescription& d, SceneFeatures& f) {
  { light.build(builder, d) } -> std::same_as<LightPointer>;
  light.count(f);
};
struct LightOperations {
  LightPointer (*build)(const void*, SceneBuilder&, const LightDescription&);
  void (*count)(const void*, SceneFeatures&);
  std::vector<std::string> (*losses)(const void*);
  LightPose pose;
  bool is_environment;

  template <LightData T>
  static constexpr LightOperations of() {
    LightOperations o{[](const void* t, SceneBuilder& builder, const LightDescription& d) {
                        return static_cast<const T*>(t)->build(builder, d);
                      },
                      [](const void* t, SceneFeatures& f) { static_cast<const T*>(t)->count(f); },
                      [](const void*) { return std::vector<std::string>(); }, LightPose::both,
                      false};
    if constexpr (requires(const T& light) { light.losses(); })
      o.losses = [](const void* t) { return static_cast<const T*>(t)->losses(); };
    if constexpr (requires { T::kPose; }) o.pose = T::kPose;
    if constexpr (requires { T::kIsEnvironment; }) o.is_environment = T::kIsEnvironment;
    return o;
  }
};
/// A light of any other plugin: whoever has a struct with a record has a light.
class ForeignLight : public Model<LightOperations> {
 public:
  using Model::Model;
  LightPointer build(SceneBuilder& b, const LightDescription& d) const;
  void count(SceneFeatures& f) const { operations().count(data(), f); }
  std::vector<std::string> losses() const { return operations().losses(data()); }
  bool is_environment() const { return operations().is_environment; }
};

}  // namespace duet
