// How light sub-paths should begin, learned from rays that were of use: at which light, in which
// direction, and of lights that are infinitely far away where they enter the scene.
#pragma once

#include <memory>
#include <vector>

#include "lights/picker.h"
#include "math/square_tree.h"

namespace duet {

/// Of each light two of the numbers that sample_emission() takes are chosen by a density over the
/// square: of lights that are infinitely far away those of the place, by a density for each
/// direction; of others those of the direction, if it depends on nothing else.
class EmissionGuide {
 public:
  /// A ray that was of use.
  struct Record {
    uint32_t light;
    Vector3f from;    ///< unit, towards the light
    Point2f numbers;  ///< guided_numbers()
    float weight;     ///< its use over the density with which it was chosen
  };

  /// `unguided` is the choice of the light without a guide. Weights of techniques count no ray of
  /// lights that are infinitely far away as more than `most` times as dense as without a guide.
  EmissionGuide(std::span<const std::unique_ptr<Light>> lights, const LightPicker& unguided,
                std::vector<Record> records, float most = INFINITY);

  /// The numbers that are guided, of a ray that comes through a point from the unit direction
  /// `from`; nothing if the light has none.
  static std::optional<Point2f> guided_numbers(const Light& light, const Vector3f& from,
                                               const Point3f& through);

  /// The light that a ray begins at; as LightPicker has them.
  LightPicker::Pick pick(float u, const Point2f& others) const { return picker_.pick(u, others); }
  float probability(uint32_t light) const { return picker_.probability(light); }

  /// By how much the density of a ray from the unit direction `from` through a point differs from
  /// what the light itself says (EmissionSample::density), as weights count it. One for lights that
  /// are not guided. Weights add up to one with any numbers in place of densities, if all
  /// techniques have the same.
  /// The light is that of the index; one that moves may be made anew.
  float factor(uint32_t index, const Light& light, const Vector3f& from,
               const Point3f& through) const;
  /// Light::sample_emission() with numbers that are guided. The weight counts the true density,
  /// the density factor().
  std::optional<EmissionSample> emit(uint32_t index, const Light& light, const Point2f& position,
                                     const Point2f& direction) const;

 private:
  /// A binary tree over the square of directions (math/equal_area.h), halved in x and y by turns.
  struct Node {
    uint32_t children[2] = {0, 0};  ///< 0: a leaf
    uint32_t numbers = 0;           ///< of a leaf: its tree
  };
  struct Cell {
    Point2f corner, size;
    int depth;
  };

  uint32_t divide(std::span<Record> records, const Cell& cell, bool may_divide);
  const SquareTree& numbers(uint32_t root, const Vector3f& from) const;

  static constexpr uint32_t kUnguided = uint32_t(-1);

  LightPicker picker_;
  std::vector<float> most_;      ///< by light: of factor()
  std::vector<uint32_t> roots_;  ///< by light; kUnguided where its numbers are not guided
  std::vector<Node> nodes_;
  std::vector<SquareTree> numbers_;
};

}  // namespace duet
