// A Bsdf: what a material becomes at a hit.
#pragma once

#include "geometry/surface.h"
#include "materials/cover.h"
#include "materials/models.h"

namespace duet {

struct BsdfEval {
  Spectrum value;  ///< f |cos θ_i| without delta lobes
  PdfW pdf;
};

/// The same with the density of the reverse direction; see Bsdf::reverse_pdf().
struct BsdfPair {
  Spectrum value;
  PdfW pdf, reverse;
};

struct BsdfSample {
  Vector3f wi;      ///< unit, in world space
  Spectrum weight;  ///< f |cos θ_i| / pdf
  PdfW pdf;         ///< of a delta lobe: the probability with which it was picked
  float eta = 1;    ///< index on the far side over that on the near side, 1 for reflection
  bool delta = false;
  bool null = false;  ///< passed straight through
};

/// One scattering model within a Bsdf.
struct BsdfComponent {
  ModelKind kind;
  /// Which of the Bsdf's covers lie over it (bump and normal maps, coats), the outer one first; −1
  /// for none.
  int8_t covers[kMaxCovers];
  /// −1 if a two-sided material is seen from its back: the z axis is then mirrored (after the
  /// covers).
  float side;
  float share;  ///< weight within the mixture and probability of being picked
  ModelUnion model;
};

/// A small closed value with plain numbers, bound to a shading frame and to the direction wo. To
/// ask it again costs no texture lookup. Mixtures (blends, masks) are lists of components whose
/// shares sum to at most one.
///
/// The two transports describe the same surface: with respect to the shading normal n, the value
/// for importance with wo = l and wi = v, over |v·n|, is the value for radiance with wo = v and wi
/// = l, over |l·n|. This holds for refraction, which scales only the latter by squared indices, and
/// under bump maps, which scale the former by what they do to the cosines.
/// Source: Veach, "Robust Monte Carlo Methods for Light Transport Simulation", 1997, section 5.3.
class Bsdf {
 public:
  /// More components in one material are refused when the scene is built.
  static constexpr int kMaxComponents = 6;
  /// And more covers over these.
  static constexpr int kMaxCoversInAll = 6;

  Bsdf() {}

  /// Value and density for the unit world direction wi.
  BsdfEval eval(const Vector3f& wi, Transport transport) const;
  /// Density with which a path that arrives from wi and carries the opposite of `transport` would
  /// be sent to wo, if the value of this pair is not zero. Delta lobes are left out; each has the
  /// same probability from both ends, except under bump maps that turn normals towards the eye.
  PdfW reverse_pdf(const Vector3f& wi, Transport transport) const;
  /// eval() and, where the value is not zero, reverse_pdf() at once.
  BsdfPair eval_both_ways(const Vector3f& wi, Transport transport) const;
  /// `u` picks the component and the lobe, `v` the direction.
  std::optional<BsdfSample> sample(float u, const Point2f& v, Transport transport) const;
  /// What passes straight through, as if there were no surface, including the probability of the
  /// lobes that let it pass.
  Spectrum straight_through() const;
  /// Whether any lobe can be met by a connection or a light sample.
  bool has_smooth() const { return has_smooth_; }
  bool has_delta() const { return has_delta_; }
  /// Whether sample() looks at `u`.
  bool needs_choice() const { return needs_choice_; }
  /// Whether photons may be merged here at all: not where most of the light is scattered by lobes
  /// that are nearly specular (kNearlySpecular). Light that arrives a little beside a point is
  /// scattered in quite another way by these, so that merging would blur and brighten what they
  /// show. The answer is the same for all directions.
  bool merges() const { return nearly_specular_share_ <= kMostNearlySpecular * smooth_share_; }
  /// The same for light that is scattered with a density, and a reverse_pdf(): where the smaller
  /// part of it meets nearly specular lobes, nothing is merged within them. The answer is the same
  /// from both ends.
  bool merges(float pdf, float reverse) const {
    return merges() && !(has_nearly_specular() && std::max(pdf, reverse) > kDensestMerged);
  }
  bool has_nearly_specular() const { return nearly_specular_share_ > 0; }

  const Frame& frame() const { return frame_; }
  /// The only component, if there is one without covers; else null.
  const BsdfComponent* only_component() const {
    return count_ == 1 && components_[0].covers[0] < 0 ? components_ : nullptr;
  }
  int component_count() const { return count_; }
  const BsdfComponent& component(int i) const { return components_[i]; }

 private:
  friend class BsdfBuilder;
  friend class Material;

  /// Share of nearly specular lobes among the smooth ones up to which photons are merged.
  static constexpr float kMostNearlySpecular = 0.5f;
  /// Per solid angle: that of the reflection off facets with α = kNearlySpecular at its peak.
  static constexpr float kDensestMerged = float(1 / (4 * kPi * kNearlySpecular * kNearlySpecular));

  bool is_plain_diffuse() const {
    return count_ == 1 && components_[0].kind == ModelKind::diffuse && components_[0].covers[0] < 0;
  }
  BsdfEval eval_all(const Vector3f& wi, Transport transport) const;
  PdfW reverse_pdf_all(const Vector3f& wi, Transport transport) const;
  std::optional<BsdfSample> sample_all(float u, const Point2f& v, Transport transport) const;

  Frame frame_;
  Vector3f wo_;  ///< in the shading frame
  int count_ = 0, cover_count_ = 0;
  bool has_smooth_ = false, has_delta_ = false, needs_choice_ = false;
  /// Of the components with smooth lobes, in sum; and what is nearly specular of it.
  float smooth_share_ = 0, nearly_specular_share_ = 0;
  union {  // keeps unused components untouched
    BsdfComponent components_[kMaxComponents];
  };
  union {
    Cover covers_[kMaxCoversInAll];
  };
};

}  // namespace duet
