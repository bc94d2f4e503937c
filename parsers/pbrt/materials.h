// What the readers of pbrt's materials share.
#pragma once

#include "pbrt/records.h"
#include "pbrt/values.h"

namespace duet::pbrt {

using ReadMaterial = std::optional<MaterialId> (*)(Values&);

/// What every material has.
inline constexpr Spec kMaterialSpecs[] = {
    {"displacement", kNumberTexture, "", "bumps", 1, Status::done, Versions::v4},
    {"bumpmap", kNumberTexture, "", "bumps", 1, Status::done, Versions::v3},
    {"normalmap", kString, "", "an image of normals", 1, Status::done, Versions::v4},
};
std::span<const Record<ReadMaterial>> materials_v4();
std::span<const Record<ReadMaterial>> materials_v3();

/// The same on both sides.
MaterialId two_sided(Values& v, MaterialId nested);
/// How the width of a distribution of microfacets follows from a roughness: v4's square root, v3's
/// polynomial.
double remapped_roughness(double roughness, Version version);
/// The roughness that the parameters say, of the names given; nothing if the surface is smooth.
std::optional<Roughness> read_roughness(Values& v, std::string_view name = "roughness",
                                        std::string_view name_u = "uroughness",
                                        std::string_view name_v = "vroughness");
/// v3's for glass, which takes a roughness of zero as it is: smooth. `name` is that of both axes.
std::optional<Roughness> read_glass_roughness(Values& v, std::string_view name);
/// A reflectance, in v4 of images that lie within [0, 1] each.
ColorInput reflectance_input(Values& v, std::string_view name);
/// A reflectance as v4's materials take it: what lies outside of [0, 1] is its nearest end.
ColorInput clamped_reflectance(Values& v, std::string_view name);
/// The same of any input.
ColorInput clamped(Values& v, const ColorInput& input);
/// The input times a constant.
ColorInput scaled(Values& v, const ColorInput& input, const Spectrum& scale);
// Materials that have files of their own; some are in both versions.
std::span<const Spec> hair_specs();
std::optional<MaterialId> read_hair(Values& v);
std::span<const Spec> disney_specs();
std::optional<MaterialId> read_disney(Values& v);
inline constexpr std::string_view kWalkInstead =
    "by random walks in a medium behind the surface, which pbrt replaces by a profile";
std::span<const Spec> subsurface_specs();
std::optional<MaterialId> read_subsurface(Values& v);
std::span<const Spec> kd_subsurface_specs();
std::optional<MaterialId> read_kd_subsurface(Values& v);
/// Reflection by a diffuse share, transmission by another.
MaterialId diffuse_both_ways(Values& v, const ColorInput& reflectance,
                             const ColorInput& transmittance);

}  // namespace duet::pbrt
