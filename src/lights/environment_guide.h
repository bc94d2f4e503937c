// Where an environment is seen from within a room, as learned from light samples: of a sky outside
// all that matters is what the windows show.
#pragma once

#include <span>
#include <vector>

#include "lights/box_walls.h"
#include "lights/light.h"
#include "math/distribution.h"

namespace duet {

/// Directions are chosen by where they leave a box around what is lit: windows in its walls stay
/// where they are, from wherever they are seen. Some are chosen by the environment itself, so that
/// nothing is lost where the walls of the room are elsewhere.
class EnvironmentGuide {
 public:
  /// A direction in which a point was lit.
  struct Record {
    Point3f at;      ///< held by the walls
    Vector3f wi;     ///< unit, towards the environment
    float use;       ///< what came from there, any unit, above zero
    PdfW pdf;        ///< with which the direction was chosen
    PdfW plain_pdf;  ///< that of the environment's own choice
  };

  EnvironmentGuide() = default;
  EnvironmentGuide(const BoxWalls& walls, std::span<const Record> records);

  /// Light::sample_direct() of an environment whose density and radiance are the same everywhere,
  /// with directions that are guided.
  std::optional<LightSample> sample_direct(const EnvironmentLight& light, const Point3f& from,
                                           const Point2f& u) const;
  /// The density with which that makes the direction `wi`.
  PdfW pdf(const EnvironmentLight& light, const Point3f& from, const Vector3f& wi) const;
  /// The second moment of light samples with this guide over that without one, from records.
  double moment(std::span<const Record> records) const;

 private:
  PdfW wall_pdf(const Point3f& from, const Vector3f& wi) const;
  PdfW mixed(PdfW plain, PdfW wall) const;

  float plain_share_ = 1;  ///< of the directions that the environment chooses
  BoxWalls walls_;
  std::vector<float> probability_;  ///< by cell of the walls
  std::vector<uint32_t> cells_;     ///< those that are chosen
  DiscreteDistribution choice_;     ///< among these
};

}  // namespace duet
