// Albedo and normal for denoisers: those of what is seen in mirrors and through glass.
#pragma once

#include "math/sampler.h"
#include "scene/scene.h"
#include "transport/counters.h"

namespace duet {

/// What a camera ray sees behind perfectly specular surfaces; zeros if that is nothing.
struct SpecularView {
  Spectrum albedo{};
  Normal3f normal{0};
};

/// Follows reflections and refractions of a camera ray, whose first hit this is, one of them at a
/// time and in proportion to what they carry, until a surface scatters light in other ways, too.
/// The albedo is an estimate, from one sample, of the share of the light that this surface scatters
/// at all, times what the reflections left of it: its mean is at most 1 where no energy is made.
/// Surfaces that let light pass straight through are passed with their probability. Media are not
/// seen. Uses the dimensions of the path's vertices.
/// Source: the documentation of Open Image Denoise, on albedos and normals of mirrors and glass.
SpecularView follow_specular(const Scene& scene, const Ray& ray, const Surface& first,
                             Sampler& sampler, RenderCounters& counters);

}  // namespace duet
