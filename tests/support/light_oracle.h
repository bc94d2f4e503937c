// The probability of a light by its definition: importances in double precision with the angles
// themselves, and all ways down the tree.
#pragma once

#include <vector>

#include "scene/scene.h"

namespace duet::test {

/// LightEstimates::importance, without the intensities in its place, and the spare room before the
/// node is not even: above zero if it is.
struct Estimate {
  double importance, spare;
};
Estimate estimate(const LightNode& node, bool directed, const Point3f& from);

/// By light, the probability that the tree chooses it.
std::vector<double> tree_probabilities(const LightTree& tree, size_t lights, const Point3f& from);

/// The probability that a light sample at `from` is taken of the light.
double direct_probability(const Scene& scene, uint32_t light, const Point3f& from);

}  // namespace duet::test
