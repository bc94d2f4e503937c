#include "mitsuba/readers.h"
#include "mitsuba/vocabulary_tables.h"

namespace duet::vocabulary {

namespace {

constexpr Parameter kStrictNormals{
    .name = "strict_normals",
    .type = boolean,
    .preset = "false",
    .note = "drop paths whose shading and geometric normals disagree",
    .versions = v0};
constexpr Parameter kHideEmitters{"hide_emitters", boolean, "false",
                                  "lights cannot be seen directly"};

constexpr Parameter kPath[] = {
    {"max_depth", integer, "-1", "longest path in segments; -1: no limit", depth},
    {"rr_depth", integer, "5", "where Russian roulette begins", positive},
    kHideEmitters,
    kStrictNormals};
constexpr Parameter kDirect[] = {
    {"shading_samples", integer, "", "sets both of the following", positive},
    {.name = "emitter_samples",
     .type = integer,
     .preset = "1",
     .range = not_negative,
     .aliases = "luminaire_samples"},
    {"bsdf_samples", integer, "1", "", not_negative},
    kHideEmitters,
    kStrictNormals};
constexpr Parameter kDepth[] = {{.name = "hide_emitters", .type = boolean, .support = inert}};
constexpr Parameter kAov[] = {
    {.name = "aovs",
     .type = string,
     .note = "name:kind, …; albedo depth position uv geo_normal sh_normal dp_du dp_dv "
             "prim_index shape_index (planned: duv_dx duv_dy)",
     .required = true},
    {.name = "hide_emitters", .type = boolean, .support = inert}};
constexpr Parameter kMoment[] = {{.name = "hide_emitters", .type = boolean, .support = inert}};

constexpr Plugin kIntegrators[] = {
    {"path", both, kPath, &read_path},
    {"direct", both, kDirect, &read_direct},
    {"depth", v3, kDepth, &read_depth},
    {"aov", v3, kAov, &read_aov, "may hold an integrator"},
    {"moment", v3, kMoment, &read_moment, "holds an integrator"},
    {.name = "adaptive",
     .versions = v0,
     .support = planned,
     .planned_parameters = "max_error max_sample_factor p_value"},
    {.name = "ao",
     .versions = v0,
     .support = planned,
     .planned_parameters = "shading_samples ray_length"},
    {.name = "bdpt",
     .versions = v0,
     .support = planned,
     .planned_parameters = "max_depth rr_depth light_image sample_direct"},
    {.name = "direct_projective",
     .versions = v3,
     .support = planned,
     .planned_parameters = "max_depth rr_depth sppc sppp sppi guiding guiding_proj guiding_rounds"},
    {.name = "erpt",
     .versions = v0,
     .support = planned,
     .planned_parameters =
         "max_depth rr_depth num_chains max_chains chain_length direct_samples lens_perturbation "
         "multi_chain_perturbation caustic_perturbation manifold_perturbation lambda"},
    {.name = "field", .versions = v0, .support = planned, .planned_parameters = "field undefined"},
    {.name = "irrcache",
     .versions = v0,
     .support = planned,
     .planned_parameters = "resolution quality gradients clamp_neighbor clamp_screen overture "
                           "quality_adjustment indirect_only debug"},
    {.name = "mlt",
     .versions = v0,
     .support = planned,
     .planned_parameters = "max_depth direct_samples luminance_samples two_stage "
                           "bidirectional_mutation lens_perturbation multi_chain_perturbation "
                           "caustic_perturbation manifold_perturbation lambda"},
    {.name = "motion", .versions = v0, .support = planned},
    {.name = "multichannel", .versions = v0, .support = planned},
    {.name = "photonmapper",
     .versions = v0,
     .support = planned,
     .planned_parameters = "direct_samples glossy_samples max_depth global_photons caustic_photons "
                           "volume_photons global_lookup_radius caustic_lookup_radius lookup_size "
                           "granularity hide_emitters rr_depth"},
    {.name = "ppm",
     .versions = v0,
     .support = planned,
     .planned_parameters =
         "max_depth photon_count initial_radius alpha granularity rr_depth max_passes"},
    {.name = "prb",
     .versions = v3,
     .support = planned,
     .planned_parameters = "max_depth rr_depth hide_emitters"},
    {.name = "prb_basic",
     .versions = v3,
     .support = planned,
     .planned_parameters = "max_depth hide_emitters"},
    {.name = "prb_projective",
     .versions = v3,
     .support = planned,
     .planned_parameters = "max_depth rr_depth sppc sppp sppi guiding guiding_proj guiding_rounds"},
    {.name = "prbvolpath",
     .versions = v3,
     .support = planned,
     .planned_parameters = "max_depth rr_depth hide_emitters"},
    {.name = "pssmlt",
     .versions = v0,
     .support = planned,
     .planned_parameters =
         "max_depth rr_depth direct_samples luminance_samples two_stage bidirectional p_large"},
    {.name = "ptracer",
     .support = planned,
     .planned_parameters =
         "max_depth rr_depth hide_emitters samples_per_pass granularity brute_force"},
    {.name = "sppm",
     .versions = v0,
     .support = planned,
     .planned_parameters =
         "max_depth photon_count initial_radius alpha granularity rr_depth max_passes"},
    {.name = "stokes", .versions = v3, .support = planned},
    {.name = "vcm",
     .versions = v0,
     .support = planned,
     .planned_parameters = "max_depth rr_depth initial_radius alpha"},
    {.name = "volpath",
     .support = planned,
     .planned_parameters = "max_depth rr_depth hide_emitters strict_normals"},
    {.name = "volpath_simple",
     .versions = v0,
     .support = planned,
     .planned_parameters = "max_depth rr_depth hide_emitters strict_normals"},
    {.name = "volpathmis",
     .versions = v3,
     .support = planned,
     .planned_parameters = "max_depth rr_depth hide_emitters use_spectral_mis"},
    {.name = "volprim_rf_basic",
     .versions = v3,
     .support = planned,
     .planned_parameters = "max_depth srgb_primitives"},
    {.name = "vpl",
     .versions = v0,
     .support = planned,
     .planned_parameters = "max_depth shadow_map_resolution clamping"},
};

// How Mitsuba builds its own acceleration structures.
constexpr Parameter kScene[] = {
    {.name = "kd_clip", .type = boolean, .support = inert},
    {.name = "kd_intersection_cost", .type = number, .support = inert},
    {.name = "kd_traversal_cost", .type = number, .support = inert},
    {.name = "kd_empty_space_bonus", .type = number, .support = inert},
    {.name = "kd_stop_prims", .type = integer, .support = inert},
    {.name = "kd_max_depth", .type = integer, .support = inert},
    {.name = "kd_exact_primitive_threshold", .type = integer, .support = inert},
    {.name = "kd_parallel_build", .type = boolean, .support = inert},
    {.name = "kd_retract", .type = boolean, .support = inert},
    {.name = "kd_max_bad_refines", .type = integer, .support = inert},
    {.name = "allow_thread_reordering", .type = boolean, .versions = v3, .support = inert},
    {.name = "embree_use_robust_intersections", .type = boolean, .versions = v3, .support = inert},
};
constexpr Plugin kScenes[] = {{.name = "scene", .parameters = kScene}};

}  // namespace

std::span<const Plugin> integrators() {
  return kIntegrators;
}
std::span<const Plugin> scenes() {
  return kScenes;
}

}  // namespace duet::vocabulary
