// What a path through coloured media carries: how much, and how likely each colour channel was to
// make it.
#pragma once

#include "math/spectrum.h"

namespace duet {

/// Distances are sampled for one channel, chosen at random, while all channels are carried. A
/// channel that scatters differently would have made the path with another density; weighing the
/// three choices against one another by the balance heuristic, together with next event estimation,
/// keeps their ratio bounded. All densities are relative to that of the chosen channel, so that in
/// grey media they are ones.
/// Source: Miller, Georgiev & Jarosz, "A null-scattering path integral formulation of light
/// transport", 2019, section 5.
struct SpectralWeights {
  Spectrum value{1};  ///< contribution over the density of the chosen channel
  Spectrum pdf{1};    ///< density of each channel's sub-path
  Spectrum light{1};  ///< density if the last direction came from a light sample, without the
                      ///< density of that sample; only where such samples compete
  int channel = 0;

  /// The value weighted among the channels, where nothing else could have made the path.
  Spectrum mean_over_channels() const { return value * (1 / pdf.mean()); }
};

}  // namespace duet
