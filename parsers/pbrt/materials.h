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
/// The input times a constant.
ColorInput scaled(Values& v, const ColorInput& input, const Spectrum& scale);
/// The medium behind a surface that the parameters of a subsurface material say; nothing after an
/// error.
std::optional<MediumDescription> read_subsurface_medium(Values& v, double eta);
/// Reflection by a diffuse share, transmission by another.
MaterialId diffuse_both_ways(Values& v, const ColorInput& reflectance,
                             const ColorInput& transmittance);

}  // namespace duet::pbrt
