// The constructs of which Mitsuba is known to be off (mitsuba_differences.h).
//
// Each function says whether a scene has one; `features` are those of the scene.
#pragma once

#include "scene/description.h"
#include "scene/features.h"

namespace duet {

/// A blend of a side that reflects by a delta lobe and one that reflects otherwise.
bool blends_delta(const SceneDescription& scene, const SceneFeatures& features);
/// Direct light with several samples of lights that no ray can hit.
bool repeats_delta_lights(const SceneDescription& scene, const SceneFeatures& features);
/// Path tracing of surfaces that light goes straight through, before no environment that is seen.
bool drops_null_paths(const SceneDescription& scene, const SceneFeatures& features);
/// Meshes that emit light and have vertex normals other than those of their triangles.
bool emits_from_smooth_meshes(const SceneDescription& scene, const SceneFeatures& features);
/// Cylinders that emit light and have no circle as their cross-section.
bool emits_from_elliptic_cylinders(const SceneDescription& scene, const SceneFeatures& features);
/// Shapes whose radiance is an attribute of their mesh.
bool emits_attributes(const SceneDescription& scene, const SceneFeatures& features);
/// Meshes that emit light by a texture of which a part lies on several triangles.
bool emits_texture_repeatedly(const SceneDescription& scene, const SceneFeatures& features);
/// A bump map over a BSDF that tells the directions along the surface apart.
bool bumps_tangents(const SceneDescription& scene, const SceneFeatures& features);
/// Light from infinitely far away, and a medium around a sensor that has no end.
bool has_light_behind_fog(const SceneDescription& scene, const SceneFeatures& features);
/// A medium whose mean free path is below 50 of Mitsuba 3's ray offsets.
bool has_short_free_path(const SceneDescription& scene, const SceneFeatures& features);
/// Surfaces in a sphere whose radius is below 100 ray offsets.
bool is_small(const SceneDescription& scene, const SceneFeatures& features);
/// Microflakes that are no balls.
bool has_uneven_flakes(const SceneDescription& scene, const SceneFeatures& features);
/// Poses that stretch along other axes than those of the thing that moves.
bool moves_sheared(const SceneDescription& scene, const SceneFeatures& features);

}  // namespace duet
