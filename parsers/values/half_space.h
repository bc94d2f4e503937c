// How much light a half-space of a scattering medium behind a smooth surface gives back, and which
// medium gives back what is asked for.
#pragma once

namespace duet {

/// Of a beam that has entered along the normal, the share that leaves again, reflections on the
/// inside included. `albedo` in [0, 1] is that of a single scattering, `g` in (−1, 1) its mean
/// cosine, `eta` > 0 the index of the medium over the outside's.
///
/// By similarity a medium scatters as one that scatters evenly with the albedo α' = α (1 − g) /
/// (1 − α g). What that one reflects without a surface is known in good approximations, for a beam
/// (Hapke, "Bidirectional Reflectance Spectroscopy 5", Icarus 157, 2002, for Chandrasekhar's H) and
/// for diffuse light (van de Hulst, "Multiple Light Scattering", 1980, vol. 2, chapter 14). Light
/// that the surface sends back is taken for diffuse. Off by at most 0.02 behind a surface with eta
/// ≥ 1.3, and by 0.045 without one, where g is large.
double half_space_reflectance(double albedo, double g, double eta);

/// The albedo with which half_space_reflectance() is `reflectance`, from 0 to 1; the nearest one if
/// there is none.
double half_space_albedo(double reflectance, double g, double eta);

}  // namespace duet
