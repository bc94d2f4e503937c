// The microfacet distributions there are, and which of them are nearly mirrors.
#pragma once

namespace duet {

enum class MicrofacetDistribution { beckmann, ggx };

/// Roughness α below which a lobe is nearly specular: what lies behind it is hard to find, and
/// photons that are merged on it blur it (Bsdf::merges()).
inline constexpr double kNearlySpecular = 0.05;

}  // namespace duet
