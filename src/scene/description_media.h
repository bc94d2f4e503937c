// Participating media as plain data.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "math/transform.h"
#include "media/volume_grid.h"
#include "scene/description_base.h"
#include "scene/field.h"

namespace duet {

class PhaseFunction;
class SceneBuilder;

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
  VolumeNodes nodes = VolumeNodes::within;

  static constexpr std::string_view kFilters[] = {"trilinear", "nearest"};
  static constexpr std::string_view kWraps[] = {"clamp", "repeat", "mirror"};
  static constexpr auto fields() {
    using namespace parameter_words;
    using enum ParameterType;
    using P = Parameter;
    using V = VolumeDescription;
    return FieldList(
        field(&V::file, P{.name = "filename", .type = file, .required = true}).not_compared(),
        field(&V::grid), field(&V::to_world, P{"to_world", transform}),
        field(&V::filter, P{"filter_type", string, kInitial, "trilinear or nearest", any, v3})
            .words(kFilters)
            .terse(),
        field(&V::wrap, P{"wrap_mode", string, kInitial, "clamp, repeat or mirror", any, v3})
            .words(kWraps)
            .terse(),
        field(&V::nodes));
  }
  static constexpr const char* name() { return "gridvolume"; }
  std::vector<std::string> losses() const;
};

using PhasePointer = std::unique_ptr<PhaseFunction>;

// What is known of a phase function stands in its struct, as for textures
// (description_textures.h).

struct IsotropicPhase {
  static constexpr auto fields() { return FieldList(); }
  static constexpr const char* name() { return "isotropic"; }
  PhasePointer build(SceneBuilder& b, const SourceLocation& where) const;
};
/// Henyey & Greenstein 1941; g is the mean cosine of the deflection.
struct HenyeyGreensteinPhase {
  double g = 0.8;
  static constexpr auto fields() {
    using namespace parameter_words;
    using enum ParameterType;
    return FieldList(field(&HenyeyGreensteinPhase::g,
                           Parameter{"g", number, kInitial, "mean cosine of the deflection"})
                         .shown(", g "));
  }
  static constexpr const char* name() { return "hg"; }
  PhasePointer build(SceneBuilder& b, const SourceLocation& where) const;
};
struct RayleighPhase {
  static constexpr auto fields() { return FieldList(); }
  static constexpr const char* name() { return "rayleigh"; }
  PhasePointer build(SceneBuilder& b, const SourceLocation& where) const;
};
/// Values at equidistant cosines of the deflection from −1 (back) to 1 (straight on), linear in
/// between; of any scale.
struct TabulatedPhase {
  std::vector<double> values;
  static constexpr auto fields() {
    using namespace parameter_words;
    using enum ParameterType;
    return FieldList(
        field(&TabulatedPhase::values,
              Parameter{.name = "values",
                        .type = string,
                        .note = "at equidistant cosines of the deflection from -1 to 1",
                        .required = true})
            .read_by_plugin());
  }
  static constexpr const char* name() { return "tabphase"; }
  PhasePointer build(SceneBuilder& b, const SourceLocation& where) const;
};
/// Microflakes whose normals are those of an ellipsoid, given by the matrix xx, yy, zz, xy, xz, yz
/// (Heitz et al. 2015). Scales the extinction by the flakes' projected area.
struct SggxPhase {
  std::variant<std::array<double, 6>, VolumeId> matrix = std::array<double, 6>{1, 1, 1, 0, 0, 0};
  static constexpr auto fields() {
    using namespace parameter_words;
    using enum ParameterType;
    return FieldList(field(&SggxPhase::matrix, Parameter{.name = "S",
                                                         .type = volume_only,
                                                         .note = "6 channels: xx, yy, zz, xy, xz, "
                                                                 "yz",
                                                         .required = true})
                         .read_by_plugin());
  }
  static constexpr const char* name() { return "sggx"; }
  std::vector<std::string> losses() const;
  PhasePointer build(SceneBuilder& b, const SourceLocation& where) const;
};
/// (1 − weight) · first + weight · second.
struct BlendPhase {
  FloatVolume weight = 0.5;
  PhaseId first{}, second{};
  static constexpr auto fields() {
    using namespace parameter_words;
    using enum ParameterType;
    return FieldList(field(&BlendPhase::weight, Parameter{"weight", number_or_volume, kInitial,
                                                          "share of the second phase function"}),
                     field(&BlendPhase::first), field(&BlendPhase::second));
  }
  static constexpr const char* name() { return "blendphase"; }
  PhasePointer build(SceneBuilder& b, const SourceLocation& where) const;
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

/// A cloud of noise: CloudShape (media/cloud.h), placed by `to_world`. pbrt has it.
struct CloudDescription {
  double density = 1, wispiness = 1, frequency = 5;
  std::array<double, 3> lower{0, 0, 0}, upper{1, 1, 1};
  Matrix4 to_world;
  static constexpr auto fields() {
    using C = CloudDescription;
    return plain_fields(&C::density, &C::wispiness, &C::frequency, &C::lower, &C::upper,
                        &C::to_world);
  }
};

/// The radiance that the absorbing part of a medium emits (pbrt's Le).
struct EmissionDescription {
  ColorVolume radiance = Spectrum(1.0f);
  /// Times the colour of black bodies of these temperatures.
  std::optional<VolumeId> temperature;
  /// Colours of temperatures from 0 to `hottest` at equal steps, linear in between.
  std::vector<Spectrum> colors;
  double hottest = 0;
  /// What `colors` are of: black bodies at (temperature − offset) · factor.
  double offset = 0, factor = 1;
  static constexpr auto fields() {
    using E = EmissionDescription;
    return plain_fields(&E::radiance, &E::temperature, &E::colors, &E::hottest, &E::offset,
                        &E::factor);
  }
};

/// Scatters, absorbs and may emit: extinction σ_t · scale per unit of length, of which `albedo` is
/// scattered.
struct MediumDescription {
  SourceLocation where;
  Label label;
  ColorVolume sigma_t = Spectrum(1.0f), albedo = Spectrum(0.75f);
  double scale = 1;
  PhaseId phase{};
  /// Multiplies the extinction, which is a constant then.
  std::optional<CloudDescription> cloud;
  std::optional<EmissionDescription> emission;
  static constexpr auto fields() {
    using namespace parameter_words;
    using enum ParameterType;
    using M = MediumDescription;
    return FieldList(
        field(&M::where), field(&M::label),
        field(&M::sigma_t,
              Parameter{"sigma_t", coefficient, kInitial, "extinction per unit of length"}),
        field(&M::albedo, Parameter{"albedo", albedo, kInitial, "share of it that is scattered"}),
        field(&M::scale, Parameter{.name = "scale",
                                   .type = number,
                                   .preset = kInitial,
                                   .note = "multiplies the extinction",
                                   .range = not_negative,
                                   .aliases = "density_multiplier size_multiplier"}),
        field(&M::phase), field(&M::cloud), field(&M::emission));
  }
  bool varies() const { return cloud || std::holds_alternative<VolumeId>(sigma_t); }
  const char* name() const { return varies() ? "heterogeneous" : "homogeneous"; }
  std::vector<std::string> losses() const;
};

}  // namespace duet
