// By how much a merge errs because the photon lies beside the vertex with which it is merged.
#pragma once

#include "integrators/pilot_light_subpaths.h"
#include "scene/scene.h"

namespace duet {

/// How a photon is moved to the vertex with which it is merged.
struct PhotonShift {
  /// Of the distance between the two that there is in the render that is asked about, whose radius
  /// is smaller; at most 1.
  float scale = 1;
  /// A number in [0, 1): where it is not below `scale`, no edge lies between the two in that
  /// render. Sub-paths through the same pixel are to have the same.
  float edge = 0;
};

/// Whether a random place within the merging radius of a vertex, beside it on its tangent plane, is
/// one where photons cannot lie: it is hidden behind what stands there, or the surface has ended.
/// The mean over `u` in [0, 1)² is the share of the photons that are missing. Counts shadow rays.
bool lacks_photons(const Scene& scene, const PathVertex& eye, float radius, const Point2f& u,
                   RenderCounters& counters);

/// What the merge of a photon with an eye vertex has too much, relative to what it contributes: one
/// minus the ratio of what the photon would bring if it had come to the vertex itself, from where
/// it comes from, to what it brings. That is other light by the scattering towards the camera with
/// its cosine, the distance and what lies between. Together with the photons that are missing
/// (lacks_photons) the mean over those of a pixel is the error of its mean, but for edges that what
/// lies farther back on the light's way makes, such as a lens. At least −1, and 1 where the vertex
/// lies in the photon's shadow or on a surface that turns away from the photon's. Counts a shadow
/// ray.
float merge_blur(const Scene& scene, const PathVertex& eye, const Point3f& photon,
                 const PhotonArrival& arrival, const PhotonShift& shift, RenderCounters& counters);

}  // namespace duet
