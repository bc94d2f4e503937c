// Integrators.
#include "mitsuba/plugins/integrators.h"

#include "mitsuba/plugins/tables.h"

namespace duet::plugins {

namespace {

void keep_name(SceneReader&, Properties& p, VolumePathIntegratorDescription& path) {
  if (p.node().type == "volpathmis") path.name = VolumePathName::volpathmis;
}

void read_counts(SceneReader&, Properties& p, DirectIntegratorDescription& direct) {
  if (p.has("shading_samples")) {
    if (!p.is_0x() && (p.has("emitter_samples") || p.has("bsdf_samples")))
      p.error(
          "shading_samples",
          "either \"shading_samples\" or \"emitter_samples\" and \"bsdf_samples\" can be given");
    direct.emitter_samples = direct.bsdf_samples = p.integer("shading_samples");
  }
  if (p.has("emitter_samples")) direct.emitter_samples = p.integer("emitter_samples");
  if (p.has("bsdf_samples")) direct.bsdf_samples = p.integer("bsdf_samples");
  constexpr int most = 1 << 16;
  if (direct.emitter_samples == 0 && direct.bsdf_samples == 0)
    p.error("bsdf_samples", "at least one sample must be taken of emitters or of BSDFs");
  if (std::max(direct.emitter_samples, direct.bsdf_samples) > most)
    p.error(direct.emitter_samples > most && p.has("emitter_samples") ? "emitter_samples"
            : p.has("bsdf_samples")                                   ? "bsdf_samples"
                                                                      : "shading_samples",
            "more than {} samples at each hit are too many", most);
}

void check_group(SceneReader&, Properties& p, PathIntegratorDescription& path) {
  check_pixel_group(p, path.pixel_group);
}

void limit_rays(SceneReader&, Properties&, OcclusionIntegratorDescription& ao) {
  ao.ray_length = std::max(ao.ray_length, 0.0);
}

constexpr Parameter kShadingSamples{"shading_samples", integer, "", "sets both of the following",
                                    positive};
constexpr Parameter kSpectralMis{"use_spectral_mis", boolean, "true", "", any, v3, inert};

}  // namespace

void check_pixel_group(Properties& p, int pixel_group) {
  if (pixel_group > kMostInGroup)
    p.error("pixel_group", "more than {} pixels in a group are too many", kMostInGroup);
}

std::vector<Plugin> integrators() {
  using Volpath = VolumePathIntegratorDescription;
  using Direct = DirectIntegratorDescription;
  const ParameterList hide = inert_parameters(boolean, "hide_emitters");
  const std::vector<Plugin> from_camera{
      method<AutoIntegratorDescription>(
          {.name = "auto", .note = "Duet's own: whichever method suits the scene (docs/auto.md)"}),
      method<PathIntegratorDescription, check_group>({.name = "path"}),
      method<Volpath>({.name = "volpath", .note = "path tracing through participating media"}),
      method<Volpath>({.name = "volpath_simple", .versions = v0, .note = "by volpath"}),
      method<Volpath, keep_name>({.name = "volpathmis",
                                  .versions = v3,
                                  .note = "by volpath, which has spectral MIS as well"},
                                 kSpectralMis),
      method<Direct, read_counts>(
          {.name = "direct", .parameters = {kShadingSamples, parameters_of<Direct>()}}),
  };
  const std::vector<Plugin> of_fields{
      method<DepthIntegratorDescription>({.name = "depth", .versions = v3, .parameters = hide}),
      aov(), moment()};
  const std::vector<Plugin> others{
      field_integrator(), multichannel(),
      method<OcclusionIntegratorDescription, limit_rays>(
          {.name = "ao", .versions = v0, .note = "in Duet; Mitsuba 3 has none"}),
      refused_plugin("motion", v0, "ways of points between two frames are no light"),
      refused_plugin("volprim_rf_basic", v3,
                     "radiance fields of volume primitives are not scenes of surfaces and media",
                     "max_depth srgb_primitives")};
  return joined(
      {from_camera, bidirectional_integrators(), of_fields, substituted_integrators(), others});
}

std::vector<Plugin> scenes() {
  // How Mitsuba builds its own acceleration structures.
  return {
      {.name = "scene",
       .parameters = {
           inert_parameters(boolean, "kd_clip"),
           inert_parameters(number, "kd_intersection_cost kd_traversal_cost kd_empty_space_bonus"),
           inert_parameters(integer, "kd_stop_prims kd_max_depth kd_exact_primitive_threshold"),
           inert_parameters(boolean, "kd_parallel_build kd_retract"),
           inert_parameters(integer, "kd_max_bad_refines"),
           inert_parameters(boolean, "allow_thread_reordering embree_use_robust_intersections",
                            v3)}}};
}

}  // namespace duet::plugins
