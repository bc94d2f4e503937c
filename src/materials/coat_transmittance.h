// How much light gets through a dielectric coat and the absorbing layer under it to a base, in all
// directions together.
#pragma once

#include <vector>

#include "materials/microfacet.h"

namespace duet {

/// What a coat does to diffuse light that meets it from the base, where every crossing of the layer
/// lets exp(−thickness / |cos θ|) pass.
struct CoatDiffuseShares {
  float returned;  ///< of what leaves the base, gets back to it
  float received;  ///< of diffuse light from outside, gets to the base
};

/// A smooth coat: of light from outside under `cosine`, what gets to the base.
float smooth_coat_transmittance(float cosine, float eta, float thickness);
CoatDiffuseShares smooth_coat_shares(float eta, float thickness);

/// The share of light from outside that gets through a rough coat to the base, for one roughness or
/// between two of them, by the cosine outside.
class CoatRow {
 public:
  static constexpr int kSize = 64;

  CoatRow() = default;
  /// `values` is followed by the row of the next roughness if `blend` is not zero.
  CoatRow(const float* values, float blend) : values_(values), blend_(blend) {}

  float operator()(float cosine) const {
    // Values are at the squares of even steps: they change fastest near the horizon.
    const float x = std::sqrt(std::max(cosine, 0.0f)) * float(kSize - 1);
    const int i = x < float(kSize - 2) ? int(x) : kSize - 2;
    const float f = std::min(x - float(i), 1.0f);
    const float t = values_[i] + f * (values_[i + 1] - values_[i]);
    if (blend_ == 0) return t;
    const float* next = values_ + kSize;
    return t + blend_ * (next[i] + f * (next[i + 1] - next[i]) - t);
  }

 private:
  const float* values_ = nullptr;
  float blend_ = 0;
};

/// Tables for a coat of GGX facets with correlated masking, each of which scatters light once. They
/// are means over low-discrepancy points, off by about 1e-3.
class CoatTransmittance {
 public:
  /// For a single roughness.
  CoatTransmittance(float eta, float thickness, float alpha);
  /// For any roughness from 0 to 1.
  CoatTransmittance(float eta, float thickness);

  struct Lookup {
    CoatRow row;
    CoatDiffuseShares shares;
  };
  /// `alpha` is not looked at if there is only one roughness. The tables must outlive the result.
  Lookup operator()(float alpha) const;

 private:
  void add_row(float eta, float thickness, float alpha);

  std::vector<float> rows_;
  std::vector<CoatDiffuseShares> shares_;
};

}  // namespace duet
