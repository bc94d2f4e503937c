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
#include "scene/field.h"

namespace duet {

/// A parameter that is either the same everywhere or varies in space.
using ColorVolume = std::variant<Spectrum, VolumeId>;
using FloatVolume = std::variant<double, VolumeId>;

/// A grid that fills the unit cube of its own space. Where it was read does not count.
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
  static constexpr auto fields() {
    using V = VolumeDescription;
    return plain_fields(&V::grid, &V::to_world, &V::filter, &V::wrap, &V::nodes_on_faces);
  }
};

struct IsotropicPhase {
  static constexpr auto fields() { return std::tuple(); }
};
/// Henyey & Greenstein 1941; g is the mean cosine of the deflection.
struct HenyeyGreensteinPhase {
  double g = 0.8;
  static constexpr auto fields() { return plain_fields(&HenyeyGreensteinPhase::g); }
};
struct RayleighPhase {
  static constexpr auto fields() { return std::tuple(); }
};
/// Values at equidistant cosines of the deflection from −1 (back) to 1 (straight on), linear in
/// between; of any scale.
struct TabulatedPhase {
  std::vector<double> values;
  static constexpr auto fields() { return plain_fields(&TabulatedPhase::values); }
};
/// Microflakes whose normals are those of an ellipsoid, given by the matrix xx, yy, zz, xy, xz, yz
/// (Heitz et al. 2015). Scales the extinction by the flakes' projected area.
struct SggxPhase {
  std::variant<std::array<double, 6>, VolumeId> matrix = std::array<double, 6>{1, 1, 1, 0, 0, 0};
  static constexpr auto fields() { return plain_fields(&SggxPhase::matrix); }
};
/// (1 − weight) · first + weight · second.
struct BlendPhase {
  FloatVolume weight = 0.5;
  PhaseId first{}, second{};
  static constexpr auto fields() {
    return plain_fields(&BlendPhase::weight, &BlendPhase::first, &BlendPhase::second);
  }
};

struct PhaseDescription {
  SourceLocation where;
  Label label;
  std::variant<IsotropicPhase, HenyeyGreensteinPhase, RayleighPhase, TabulatedPhase, SggxPhase,
               BlendPhase>
      model;
  static constexpr auto fields() {
    return plain_fields(&PhaseDescription::where, &PhaseDescription::label,
                        &PhaseDescription::model);
  }
};

/// Scatters and absorbs: extinction σ_t · scale per unit of length, of which `albedo` is scattered.
struct MediumDescription {
  SourceLocation where;
  Label label;
  ColorVolume sigma_t = Spectrum(1.0f), albedo = Spectrum(0.75f);
  double scale = 1;
  PhaseId phase{};
  static constexpr auto fields() {
    return plain_fields(&MediumDescription::where, &MediumDescription::label,
                        &MediumDescription::sigma_t, &MediumDescription::albedo,
                        &MediumDescription::scale, &MediumDescription::phase);
  }
};

}  // namespace duet
