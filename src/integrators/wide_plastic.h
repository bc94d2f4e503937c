// What batches of paths do at points of plastics, rough and smooth.
#pragma once

#include "integrators/wide_glossy.h"
#include "materials/plain_diffuse.h"

namespace duet {

/// Whether part of what such surfaces scatter is that of a diffuse base.
template <class Surface>
inline constexpr bool kHasBase =
    std::is_same_v<Surface, PlasticSurface> || std::is_same_v<Surface, RoughPlasticSurface>;

/// Values for the directions `out.towards`, at `n` points of one plastic; the reflectance is that
/// of the base.
void evaluate_glossy(int n, const RoughPlasticSurface& surface, const WideVertices& vertices,
                     WideGlossy& out);
/// Directions from there.
void sample_glossy(int n, const RoughPlasticSurface& surface, const WideVertices& vertices,
                   WideGlossy& out);
/// The reverse densities for `out.towards`.
void reverse_glossy(int n, const RoughPlasticSurface& surface, const WideVertices& vertices,
                    WideGlossy& out);

/// The factor of what the base scatters by which it depends on the direction it is seen from, for
/// the cosines of `n` directions.
void see_bases(int n, const RoughPlasticSurface& surface, const float* cosines, float* factors);

/// The same of smooth plastics, without what the coat mirrors. Of directions that it mirrors the
/// density is negative.
void evaluate_glossy(int n, const PlasticSurface& surface, const WideVertices& vertices,
                     WideGlossy& out);
void sample_glossy(int n, const PlasticSurface& surface, const WideVertices& vertices,
                   WideGlossy& out);
void reverse_glossy(int n, const PlasticSurface& surface, const WideVertices& vertices,
                    WideGlossy& out);

void see_bases(int n, const PlasticSurface& surface, const float* cosines, float* factors);

}  // namespace duet
