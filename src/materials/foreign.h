// A scattering model that is not in the closed set of models.h.
#pragma once

#include <cstddef>
#include <cstring>
#include <new>
#include <type_traits>

#include "materials/model.h"

namespace duet {

/// Carries any small model as bytes and asks it through a table of functions: two loads more than
/// for the models of the closed set, which do not notice that there is one. What such a model lets
/// pass straight through is not known to Bsdf::straight_through().
class ForeignModel {
 public:
  /// Bytes that a model may have.
  static constexpr size_t kRoom = 128;

  template <ScatteringModel M>
  requires(!std::is_same_v<M, ForeignModel>) explicit ForeignModel(const M& model)
      : functions_(&kFunctions<M>) {
    static_assert(std::is_trivially_copyable_v<M> && sizeof(M) <= kRoom && alignof(M) <= 8);
    std::memcpy(room_, &model, sizeof(M));
  }

  ModelEval eval(const Vector3f& wo, const Vector3f& wi, Transport transport) const {
    return functions_->eval(room_, wo, wi, transport);
  }
  std::optional<ModelSample> sample(const Vector3f& wo, float u, const Point2f& v,
                                    Transport transport) const {
    return functions_->sample(room_, wo, u, v, transport);
  }
  bool has_smooth() const { return functions_->facts(room_).smooth; }
  bool has_delta() const { return functions_->facts(room_).delta; }
  bool needs_choice() const { return functions_->facts(room_).choice; }
  float nearly_specular_share() const { return functions_->facts(room_).nearly_specular; }

 private:
  struct Facts {
    bool smooth, delta, choice;
    float nearly_specular;
  };
  struct Functions {
    ModelEval (*eval)(const std::byte*, const Vector3f&, const Vector3f&, Transport);
    std::optional<ModelSample> (*sample)(const std::byte*, const Vector3f&, float, const Point2f&,
                                         Transport);
    Facts (*facts)(const std::byte*);
  };
  template <class M>
  static const M& as(const std::byte* room) {
    return *std::launder(reinterpret_cast<const M*>(room));
  }
  template <class M>
  static constexpr Functions kFunctions{
      [](const std::byte* room, const Vector3f& wo, const Vector3f& wi, Transport transport) {
        return as<M>(room).eval(wo, wi, transport);
      },
      [](const std::byte* room, const Vector3f& wo, float u, const Point2f& v,
         Transport transport) { return as<M>(room).sample(wo, u, v, transport); },
      [](const std::byte* room) {
        const M& m = as<M>(room);
        return Facts{m.has_smooth(), m.has_delta(), m.needs_choice(),
                     duet::nearly_specular_share(m)};
      }};

  const Functions* functions_;
  alignas(8) std::byte room_[kRoom];
};

}  // namespace duet
