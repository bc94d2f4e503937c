// The most frequent material, bound without the machinery of all others.
#pragma once

#include <variant>

#include "materials/material.h"
#include "textures/texture.h"

namespace duet {

/// A Material that is nothing but a DiffuseModel of constant reflectance, at a surface point: the
/// same numbers as its Bsdf gives, by the same functions, so that code can be written for either.
class PlainDiffuse {
 public:
  static bool suits(const Material& material) {
    return material.constant() && material.constant()->component.kind == ModelKind::diffuse;
  }

  /// The side of the shading normal on which the surface is lit, ±1, or 0 if that is not the side
  /// of wo, whose cosine is given.
  [[gnu::always_inline]] static float lit_side(float cosine, bool two_sided) {
    const float back = two_sided ? -1.0f : 0.0f;
    return cosine > 0 ? 1.0f : cosine < 0 ? back : 0.0f;
  }

  /// `wo` is a unit vector in world space.
  PlainDiffuse(const Material& material, const Surface& s, const Vector3f& wo)
      : frame_(s.shading),
        reflectance_(material.constant()->component.model.diffuse.reflectance),
        has_smooth_(material.constant()->has_smooth) {
    side_ = lit_side(dot(frame_.n, wo), material.constant()->two_sided);
  }

  bool has_smooth() const { return has_smooth_; }
  bool needs_choice() const { return false; }

  BsdfEval eval(const Vector3f& wi, Transport) const {
    const float cosine = dot(frame_.n, wi) * side_;
    if (!(cosine > 0)) return {};
    const float pdf = cosine * kInvPi;
    return {reflectance_ * pdf, PdfW{pdf}};
  }

  std::optional<BsdfSample> sample(float, const Point2f& v, Transport) const {
    std::optional<BsdfSample> out;
    const Vector3f wi = square_to_cosine_hemisphere(v);
    if (side_ == 0 || !(wi.z > 0)) return out;
    out.emplace();
    out->wi = frame_.to_world({wi.x, wi.y, wi.z * side_});
    out->weight = reflectance_;
    out->pdf.value = wi.z * kInvPi;
    return out;
  }

 private:
  const Frame& frame_;
  Spectrum reflectance_;
  bool has_smooth_;
  float side_;  ///< on which the surface is lit, 0 if not on that of wo
};

/// A material that is nothing but a DiffuseModel, with or without textures, on one or both sides.
struct DiffuseSurface {
  const ColorSlot& reflectance;
  bool two_sided;
};
/// The material as such, if it is one.
std::optional<DiffuseSurface> as_diffuse(const Material& material);

/// A material that is nothing but a rough plastic on one or both sides, with visible facets (GGX
/// without correlation, or Beckmann) and a coat that is the same everywhere, reflects anything and
/// has an index that is not 1.
struct RoughPlasticSurface {
  const ColorSlot& base;
  UniformRoughPlastic plastic;
  bool two_sided;
};
/// The material as such, if it is one.
std::optional<RoughPlasticSurface> as_rough_plastic(const Material& material);

/// A material that is nothing but a smooth plastic on one or both sides, with a coat that is the
/// same everywhere and reflects anything.
struct PlasticSurface {
  const ColorSlot& base;
  UniformPlastic plastic;
  bool two_sided;
};
/// The material as such, if it is one.
std::optional<PlasticSurface> as_plastic(const Material& material);

/// A material that is nothing but a rough conductor on one or both sides, with such facets and an
/// index that is the same everywhere.
struct RoughConductorSurface {
  const ColorSlot& reflectance;
  RoughConductorModel conductor;  ///< its specular reflectance is 1
  bool two_sided;
};
/// The material as such, if it is one.
std::optional<RoughConductorSurface> as_rough_conductor(const Material& material);

/// A material that is nothing but Burley's without transmission, clear coat and anisotropy, on one
/// or both sides, which is the same everywhere but for its colour.
struct PrincipledSurface {
  const ColorSlot& base_color;
  PrincipledModel model;  ///< its base colour is 1
  bool two_sided;
};
/// The material as such, if it is one.
std::optional<PrincipledSurface> as_principled(const Material& material);

/// A material that is nothing but a rough dielectric that is the same everywhere, with such facets
/// and an index that is not 1.
struct RoughDielectricSurface {
  RoughDielectricModel dielectric;
};
/// The material as such, if it is one.
std::optional<RoughDielectricSurface> as_rough_dielectric(const Material& material);

/// A material with delta lobes alone that is the same everywhere: glass, a pane or a mirror, the
/// last on one or both sides.
struct SpecularSurface {
  std::variant<DielectricModel, ThinDielectricModel, ConductorModel> model;
  bool two_sided;
};
/// The material as such, if it is one.
std::optional<SpecularSurface> as_specular(const Material& material);

class Perturbed;

/// A bump or normal map over another material, on one or both sides.
struct PerturbedSurface {
  const Perturbed& map;
  bool two_sided;  ///< the back looks like the front
};
/// The material as such, if it is one.
std::optional<PerturbedSurface> as_perturbed(const Material& material);

class Mask;

/// The material as a mask, or null if it is none.
const Mask* as_mask(const Material& material);

}  // namespace duet
