// The closed set of scattering models. A new model is added to the list here; one that is not in it
// is a ForeignModel.
#pragma once

#include <type_traits>

#include "materials/coat_reflection.h"
#include "materials/coated_diffuse.h"
#include "materials/conductor.h"
#include "materials/dielectric.h"
#include "materials/diffuse.h"
#include "materials/diffuse_transmitter.h"
#include "materials/filter.h"
#include "materials/foreign.h"
#include "materials/fresnel_blend.h"
#include "materials/hair.h"
#include "materials/layered.h"
#include "materials/measured.h"
#include "materials/null.h"
#include "materials/phong.h"
#include "materials/plastic.h"
#include "materials/polarized_plastic.h"
#include "materials/principled.h"
#include "materials/principledthin.h"
#include "materials/rough_diffuse.h"
#include "materials/thin_layer.h"
#include "materials/thindielectric.h"
#include "materials/ward.h"

/// X(enumerator, type) for each model.
#define DUET_BSDF_MODELS(X)                       \
  X(diffuse, DiffuseModel)                        \
  X(null, NullModel)                              \
  X(conductor, ConductorModel)                    \
  X(rough_conductor, RoughConductorModel)         \
  X(dielectric, DielectricModel)                  \
  X(rough_dielectric, RoughDielectricModel)       \
  X(thin_dielectric, ThinDielectricModel)         \
  X(plastic, PlasticModel)                        \
  X(rough_plastic, RoughPlasticModel)             \
  X(principled, PrincipledModel)                  \
  X(principled_thin, PrincipledThinModel)         \
  X(phong, PhongModel)                            \
  X(ward, WardModel)                              \
  X(rough_diffuse, RoughDiffuseModel)             \
  X(diffuse_transmitter, DiffuseTransmitterModel) \
  X(hair, HairModel)                              \
  X(measured, MeasuredModel)                      \
  X(polarized_plastic, PolarizedPlasticModel)     \
  X(filter, FilterModel)                          \
  X(coat_reflection, CoatReflectionModel)         \
  X(thin_layer, ThinLayerModel)                   \
  X(coated_diffuse, CoatedDiffuseModel)           \
  X(layered, LayeredModel)                        \
  X(fresnel_blend, FresnelBlendModel)             \
  X(foreign, ForeignModel)

namespace duet {

#define DUET_ENUMERATOR(name, type) name,
enum class ModelKind : uint8_t { DUET_BSDF_MODELS(DUET_ENUMERATOR) };
#undef DUET_ENUMERATOR

/// Room for any one model; the kind is kept beside it.
union ModelUnion {
  ModelUnion() {}
#define DUET_MEMBER(name, type) type name;
  DUET_BSDF_MODELS(DUET_MEMBER)
#undef DUET_MEMBER
};

#define DUET_CHECK(name, type)                           \
  static_assert(ScatteringModel<type>);                  \
  static_assert(std::is_trivially_copyable_v<type>);     \
  static_assert(std::is_trivially_destructible_v<type>); \
  static_assert(sizeof(type) <= 144);
DUET_BSDF_MODELS(DUET_CHECK)
#undef DUET_CHECK

/// Stores `model` and its kind in anything with members `kind` and `model`.
#define DUET_SET(name, type)                        \
  template <class Component>                        \
  void set_model(Component& c, const type& model) { \
    c.kind = ModelKind::name;                       \
    c.model.name = model;                           \
  }
DUET_BSDF_MODELS(DUET_SET)
#undef DUET_SET

/// Calls `f` with the model that is stored in `c`.
template <class Component, class F>
inline auto visit_model(const Component& c, F&& f) {
  switch (c.kind) {
#define DUET_CASE(name, type) \
  case ModelKind::name:       \
    return f(c.model.name);
    DUET_BSDF_MODELS(DUET_CASE)
#undef DUET_CASE
  }
  __builtin_unreachable();
}

}  // namespace duet
