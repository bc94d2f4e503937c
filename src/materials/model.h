// The contract of a scattering model: what each BSDF file implements.
#pragma once

#include <cstdint>
#include <optional>

#include "math/frame.h"
#include "math/measure.h"
#include "math/spectrum.h"

namespace duet {

/// What is carried along the path that a BSDF is asked about. Refraction scales radiance by the
/// square of the relative index but leaves importance alone (Veach 1997, section 5.2).
enum class Transport : uint8_t { radiance, importance };

/// Value f(wo, wi) |cos θ_i| of the smooth lobes and the density with which sample() makes wi.
struct ModelEval {
  Spectrum value;
  float pdf = 0;  ///< per solid angle of wi
};

struct ModelSample {
  Vector3f wi;
  Spectrum weight;  ///< f |cos θ_i| / pdf, or the delta lobe's coefficient over its probability
  float pdf = 0;    ///< per solid angle; for a delta lobe its probability
  float eta = 1;    ///< index on wi's side over that on wo's side (1 for reflection)
  bool delta = false;
  bool null = false;  ///< passed straight through, as if there were no surface
};

/// The sample that a direction makes whose value and density are known; empty if it has no density.
inline std::optional<ModelSample> sample_from(const ModelEval& e, const Vector3f& wi) {
  if (!(e.pdf > 0)) return std::nullopt;
  return ModelSample{wi, e.value / e.pdf, e.pdf};
}

/// A sample that is made without branches, for loops over many points.
struct BranchFreeSample {
  Vector3f wi;
  Spectrum weight;  ///< of no meaning, as the rest, if nothing is carried
  float pdf = 0, eta = 1;
  int32_t carries = 1, delta = 0, null = 0;  ///< 0 or 1

  std::optional<ModelSample> model_sample() const {
    if (!carries) return std::nullopt;
    return ModelSample{wi, weight, pdf, eta, delta != 0, null != 0};
  }
};

/// A model has its parameters as plain numbers, already looked up at the hit. Directions are unit
/// vectors in the local frame and point away from the surface: wo to where the path comes from, wi
/// to where it goes. All functions are const and know nothing of the frame. Each model provides
///
///   ModelEval eval(wo, wi, transport)            smooth lobes only; zero if there are none
///   std::optional<ModelSample> sample(wo, u, v, transport)
///                                                u picks the lobe, v the direction; empty if the
///                                                direction made carries nothing
///   bool has_smooth(), has_delta()               which kinds of lobes there are
///   bool needs_choice()                          whether sample() looks at u
///
/// eval and sample must agree: over many samples, mean(weight · g(wi)) = ∫ f |cos| g dwi plus the
/// delta terms. The density of the reverse direction is obtained by swapping wo and wi and
/// taking the other transport; a delta lobe is picked with the same probability from either end.
///
/// A model with delta lobes that is asked for many points at once also provides
///
///   BranchFreeSample sample_branch_free(wo, u, v, transport)
///                                                what sample() makes
///
/// A model that may have nearly specular lobes also provides
///
///   float nearly_specular_share()                share of these in the light that its smooth lobes
///                                                scatter, from 0 to 1; the same for all directions
///
/// One whose value takes more work than its density also provides
///
///   float density(wo, wi)                        eval().pdf, which does not depend on the
///   transport
template <class M>
concept ScatteringModel = requires(const M& m, const Vector3f& w, float u, const Point2f& v) {
  { m.eval(w, w, Transport::radiance) } -> std::same_as<ModelEval>;
  { m.sample(w, u, v, Transport::radiance) } -> std::same_as<std::optional<ModelSample>>;
  { m.has_smooth() } -> std::same_as<bool>;
  { m.has_delta() } -> std::same_as<bool>;
  { m.needs_choice() } -> std::same_as<bool>;
};

template <ScatteringModel M>
inline float nearly_specular_share(const M& model) {
  if constexpr (requires { model.nearly_specular_share(); })
    return model.nearly_specular_share();
  else
    return 0;
}

}  // namespace duet
