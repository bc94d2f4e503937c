// Layers of the image other than its colours: what is seen at the first hit, and statistics.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "integrators/specular_layers.h"
#include "scene/scene.h"

namespace duet {

enum class LayerKind {
  albedo,
  depth,  ///< distance from the camera
  position,
  uv,
  normal,  ///< of shading
  geo_normal,
  dp_du,
  dp_dv,
  duv_dx,  ///< change of uv from one pixel to the next on the right
  duv_dy,  ///< the same to the one below
  dz_dx,   ///< change of the position's z from one pixel to the next on the right
  dz_dy,   ///< the same to the one below
  prim_index,
  shape_index,
  moments,            ///< mean of the squares of the samples' colours
  variance,           ///< of the pixel's colours, as if samples were independent
  sample_variance,    ///< of the colours of a pixel's samples
  relative_variance,  ///< the same, over their mean
  samples,            ///< number of samples of the pixel
  denoise_albedo,     ///< through perfectly specular surfaces (specular_layers.h)
  denoise_normal,
  denoise_split,  ///< colours, and 1, with signs that tell two halves of the samples
};

struct Layer {
  LayerKind kind;
  std::string name;       ///< prefix of its channels
  bool in_frame = false;  ///< AovDescription::Layer::in_frame
};

/// The kind with this name: those of Mitsuba's `aov` plugin (sh_normal, …) and of the command line
/// (normal, shape, …).
std::optional<LayerKind> find_layer(const std::string& name);
/// The names that find_layer() knows.
const std::vector<std::string>& layer_names();
/// The channels of a layer, "name.X" and so on.
std::vector<std::string> layer_channels(const Layer& layer);
/// What a layer asks of surfaces.
SurfaceNeeds layer_needs(LayerKind kind);

/// Whether a layer looks at where the neighbouring pixels' rays go.
bool layer_needs_next_rays(LayerKind kind);

/// Whether a layer is made of the samples' colours.
bool layer_needs_image(LayerKind kind);

/// Whether a layer is of what is seen in mirrors and through glass.
bool layer_follows_specular(LayerKind kind);

/// Writes the layer denoise_split of one sample of a pixel: from the colours' mean with signs, that
/// without and the mean of the signs follow those of two halves of the samples. Each is made of the
/// longest runs of samples that there are for any number of them: such are nearly as well spread as
/// the whole.
void evaluate_split(uint32_t sample, const Spectrum& radiance, std::span<float> out);

/// What a camera ray has hit.
struct LayerPoint {
  const Surface& surface;
  Vector3f wo;  ///< of unit length, towards the camera
  Hit hit;
  /// The rays beside it, or null if there are none or the layer does not need them.
  const NextRays* next;
  /// What is seen in mirrors and through glass, or null if the layer does not need it.
  const SpecularView* specular = nullptr;
  /// Where positions and normals are told (AovDescription::frame), or null for the world.
  const Transform* frame = nullptr;
};

/// Writes the layer's value at a point; nothing for statistics. A miss leaves zeros.
void evaluate_layer(LayerKind kind, const Scene& scene, const LayerPoint& point,
                    std::span<float> out);

}  // namespace duet
