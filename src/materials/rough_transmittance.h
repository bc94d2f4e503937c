// How much light passes a rough dielectric interface, in all directions together: what the diffuse
// base of a rough plastic receives and what it gives back.
#pragma once

#include <vector>

#include "materials/microfacet_kind.h"

namespace duet {

/// Transmittance of an interface for light from outside under one roughness, or a row between two.
class TransmittanceRow {
 public:
  static constexpr int kSize = 64;

  TransmittanceRow() = default;
  /// `values` is followed by the row of the next roughness if `blend` is not zero, and in any case
  /// by another value, which counts for nothing.
  TransmittanceRow(const float* values, float blend) : values_(values), blend_(blend) {}

  /// The first of the two rows: the same where nothing is blended.
  [[gnu::always_inline]] TransmittanceRow first() const { return {values_, 0}; }
  /// For a cosine in [0, 1] outside.
  [[gnu::always_inline]] float operator()(float cosine) const {
    const float x = cosine * float(kSize - 1);
    // Within the table whatever the cosine: loops over many points look up what they do not use.
    const int i = int(x) & (kSize - 1);
    const float f = x - float(i);
    const float t = values_[i] + f * (values_[i + 1] - values_[i]);
    if (blend_ == 0) return t;
    const float* next = values_ + kSize;
    return t + blend_ * (next[i] + f * (next[i + 1] - next[i]) - t);
  }

 private:
  const float* values_ = nullptr;
  float blend_ = 0;
};

/// Tables for one interface. As in Mitsuba 3, directions in between are interpolated linearly from
/// 64 cosines, and the diffuse reflectance from inside is a plain mean over such cosines.
class RoughTransmittance {
 public:
  /// For a single roughness.
  RoughTransmittance(MicrofacetDistribution distribution, float eta, float alpha);
  /// For any roughness.
  RoughTransmittance(MicrofacetDistribution distribution, float eta);

  struct Lookup {
    TransmittanceRow external;
    float internal_reflectance;  ///< of diffuse light from the inside
  };
  /// `alpha` is not looked at if there is only one roughness. The tables must outlive the result.
  Lookup operator()(float alpha) const;

 private:
  void add_row(MicrofacetDistribution distribution, float eta, float alpha);

  std::vector<float> external_;
  std::vector<float> internal_;
};

}  // namespace duet
