// The microfacet distributions there are, and which of them are nearly mirrors.
#pragma once

#include <string_view>

namespace duet {

/// With the masking of both directions as if they were independent; `ggx_correlated` takes into
/// account that facets which lie low are hidden from both (Heitz 2014, section 6), as pbrt does.
enum class MicrofacetDistribution { beckmann, ggx, ggx_correlated };

/// By the distribution.
inline constexpr std::string_view kMicrofacetNames[] = {"beckmann", "ggx", "ggx_correlated"};

/// Roughness α below which a lobe is nearly specular: what lies behind it is hard to find, and
/// photons that are merged on it blur it (Bsdf::merges()).
inline constexpr double kNearlySpecular = 0.05;

}  // namespace duet
