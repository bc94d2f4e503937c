// Renders ids and coverages: which things are seen in each pixel, and in how much of it.
#pragma once

#include "image/cryptomatte.h"
#include "integrators/integrator.h"
#include "scene/scene_names.h"

namespace duet {

struct MatteRequest {
  std::vector<MatteKind> kinds;
  SampleSequence sequence = SampleSequence::sobol;
  uint64_t seed = 0;
  uint32_t spp = 1;
  int threads = 1;
  bool hides_lights = false;  ///< whether the camera sees through surfaces that shine
};

/// The layers of `kinds`, over the window of a film. A pixel's coverages are shares of its samples,
/// which are those with which a path tracer renders it: the first surface that does not let the
/// light of the sample straight through counts, as masks and null BSDFs may. Where nothing is seen
/// nothing is covered. Media hide nothing. What moves is seen at the time of each sample. Counts
/// are whole numbers and equal ones are in the order of the ids, so that nothing depends on the
/// number of threads.
Image render_mattes(const Scene& scene, const SceneNames& names, const FilmLayout& layout,
                    const MatteRequest& request);

/// Bytes that this takes at the most, the image included.
double matte_bytes(const FilmLayout& layout, size_t kinds, bool moves);

}  // namespace duet
