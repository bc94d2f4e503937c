// Where rays from lights that are infinitely far away enter the scene, learned from rays that were
// of use: a density over the disk across each direction.
#pragma once

#include <memory>
#include <vector>

#include "lights/light.h"
#include "math/square_tree.h"

namespace duet {

class EmissionGuide {
 public:
  /// A ray that was of use.
  struct Record {
    uint32_t light;
    Vector3f from;  ///< unit, towards the light
    Point2f entry;  ///< SceneSphere::entry()
    float weight;   ///< its use over the density with which it was chosen
  };

  /// Guides the lights that have an entered_sphere(). Weights of techniques count no ray as more
  /// than `most` times as dense as without a guide.
  EmissionGuide(std::span<const std::unique_ptr<Light>> lights, std::vector<Record> records,
                float most = INFINITY);

  /// By how much the density of a ray from the unit direction `from` through a point differs from
  /// what the light itself says (EmissionSample::density), as weights count it. One for lights that
  /// are not guided. Weights add up to one with any numbers in place of densities, if all
  /// techniques have the same.
  /// The light is that of the index; one that moves may be made anew.
  float factor(uint32_t index, const Light& light, const Vector3f& from,
               const Point3f& through) const;
  /// Lets the ray that the light has made enter elsewhere. `position` is what the light had for the
  /// place. Its weight counts the true density, its density the factor().
  void redirect(uint32_t index, const Light& light, const Point2f& position,
                EmissionSample& emission) const;

 private:
  /// A binary tree over the square of directions (math/equal_area.h), halved in x and y by turns.
  struct Node {
    uint32_t children[2] = {0, 0};  ///< 0: a leaf
    uint32_t entries = 0;           ///< of a leaf: its tree
  };
  struct Cell {
    Point2f corner, size;
    int depth;
  };

  uint32_t divide(std::span<Record> records, const Cell& cell, bool may_divide);
  const SquareTree& entries(uint32_t root, const Vector3f& from) const;

  static constexpr uint32_t kUnguided = uint32_t(-1);

  float most_;
  std::vector<uint32_t> roots_;  ///< by light; kUnguided where it is not guided
  std::vector<Node> nodes_;
  std::vector<SquareTree> entries_;
};

}  // namespace duet
