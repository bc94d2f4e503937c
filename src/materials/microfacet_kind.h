// The microfacet distributions there are.
#pragma once

namespace duet {

enum class MicrofacetDistribution { beckmann, ggx };

}  // namespace duet
