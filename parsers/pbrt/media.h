// What reads media, one function per plugin; each is called with the parameters of its record.
#pragma once

#include <functional>

#include "pbrt/values.h"

namespace duet::pbrt {

MediumDescription read_homogeneous(Values& v);
MediumDescription read_uniform_grid(Values& v);
MediumDescription read_rgb_grid(Values& v);
MediumDescription read_nano_vdb(Values& v);
MediumDescription read_cloud(Values& v);

/// Extinction, albedo and phase function by "sigma_a", "sigma_s", "scale" and "g".
MediumDescription medium_from_sigma(Values& v);
PhaseId read_phase(Values& v);

/// The numbers of cells; nothing after an error.
std::optional<std::array<int, 3>> grid_size(Values& v, size_t cells);
/// A grid over the medium's box. Around it there are cells of zero, half of whose reach lies within
/// the box; outside of that is nothing. If it `goes_on`, its outermost cells are repeated instead.
VolumeId add_grid(Values& v, const std::array<int, 3>& n, int channels,
                  const std::function<float(size_t cell, int channel)>& value,
                  bool goes_on = false);

// Emission (media_emission.cpp); none if the parameters say nothing of it.
std::optional<EmissionDescription> read_constant_emission(Values& v);
/// By "Le" or "temperature" per cell, and "Lescale".
std::optional<EmissionDescription> read_grid_emission(Values& v, const std::array<int, 3>& size);
/// By "Le" per cell of an rgbgrid.
std::optional<EmissionDescription> read_rgb_emission(Values& v, const std::array<int, 3>& size);
/// By the grid that holds temperatures up to `hottest`.
EmissionDescription emission_by_temperature(Values& v, ColorVolume scale, VolumeId temperature,
                                            double hottest);

}  // namespace duet::pbrt
