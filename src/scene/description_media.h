// Participating media as plain data.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "math/transform.h"
#include "media/volume_grid.h"
#include "scene/description_base.h"

namespace duet {

/// A parameter that is either the same everywhere or varies in space.
using ColorVolume = std::variant<Spectrum, VolumeId>;
using FloatVolume = std::variant<double, VolumeId>;

/// A grid that fills the unit cube of its own space.
struct VolumeDescription {
  SourceLocation where;
  Label label;
  std::string file;  ///< resolved path, or "" for a grid made by the program
  std::shared_ptr<const VolumeGrid> grid;
  /// Whether Mitsuba 3 can read the file: it knows only 32-bit floating-point numbers.
  bool is_float32 = true;
  Matrix4 to_world;
  VolumeFilter filter = VolumeFilter::trilinear;
  VolumeWrap wrap = VolumeWrap::clamp;
  /// The outermost nodes lie on the cube's faces (0.x), not half a cell inside them (3.x).
  bool nodes_on_faces = false;
  friend bool operator==(const VolumeDescription& a, const VolumeDescription& b) {
    return a.to_world == b.to_world && a.filter == b.filter && a.wrap == b.wrap &&
           a.nodes_on_faces == b.nodes_on_faces &&
           (a.grid == b.grid || (a.grid && b.grid && *a.grid == *b.grid));
  }
};

struct IsotropicPhase {
  bool operator==(const IsotropicPhase&) const = default;
};
/// Henyey & Greenstein 1941; g is the mean cosine of the deflection.
struct HenyeyGreensteinPhase {
  double g = 0.8;
  bool operator==(const HenyeyGreensteinPhase&) const = default;
};
struct RayleighPhase {
  bool operator==(const RayleighPhase&) const = default;
};
/// Values at equidistant cosines of the deflection from −1 (back) to 1 (straight on), linear in
/// between; of any scale.
struct TabulatedPhase {
  std::vector<double> values;
  bool operator==(const TabulatedPhase&) const = default;
};
/// Microflakes whose normals are those of an ellipsoid, given by the matrix xx, yy, zz, xy, xz, yz
/// (Heitz et al. 2015). Scales the extinction by the flakes' projected area.
struct SggxPhase {
  std::variant<std::array<double, 6>, VolumeId> matrix = std::array<double, 6>{1, 1, 1, 0, 0, 0};
  bool operator==(const SggxPhase&) const = default;
};
/// (1 − weight) · first + weight · second.
struct BlendPhase {
  FloatVolume weight = 0.5;
  PhaseId first{}, second{};
  bool operator==(const BlendPhase&) const = default;
};

struct PhaseDescription {
  SourceLocation where;
  Label label;
  std::variant<IsotropicPhase, HenyeyGreensteinPhase, RayleighPhase, TabulatedPhase, SggxPhase,
               BlendPhase>
      model;
  bool operator==(const PhaseDescription&) const = default;
};

/// Scatters and absorbs: extinction σ_t · scale per unit of length, of which `albedo` is scattered.
struct MediumDescription {
  SourceLocation where;
  Label label;
  ColorVolume sigma_t = Spectrum(1.0f), albedo = Spectrum(0.75f);
  double scale = 1;
  PhaseId phase{};
  bool operator==(const MediumDescription&) const = default;
};

}  // namespace duet
