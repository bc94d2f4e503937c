#include "mitsuba/readers.h"
#include "mitsuba/vocabulary_tables.h"

namespace duet::vocabulary {

namespace {

constexpr Parameter kMaxDepth{"max_depth", integer, "-1", "longest path in segments; -1: no limit",
                              depth};
constexpr Parameter kRrDepth{"rr_depth", integer, "5", "where Russian roulette begins", positive};
constexpr Parameter kStrictNormals{
    .name = "strict_normals",
    .type = boolean,
    .preset = "false",
    .note = "drop paths whose shading and geometric normals disagree",
    .versions = v0};
constexpr Parameter kHideEmitters{"hide_emitters", boolean, "false",
                                  "lights cannot be seen directly"};

constexpr Parameter kPath[] = {kMaxDepth, kRrDepth, kHideEmitters, kStrictNormals};
constexpr Parameter kVolumeDepth{
    "max_depth", integer, "-1",
    "longest path in segments; surfaces that light passes straight do not count; -1: no limit",
    depth};
constexpr Parameter kVolpath[] = {kVolumeDepth, kRrDepth, kHideEmitters, kStrictNormals};
constexpr Parameter kVolpathmis[] = {kVolumeDepth,
                                     kRrDepth,
                                     kHideEmitters,
                                     kStrictNormals,
                                     {.name = "use_spectral_mis",
                                      .type = boolean,
                                      .preset = "true",
                                      .versions = v3,
                                      .support = inert}};
constexpr Parameter kOcclusion[] = {
    {"shading_samples", integer, "1", "", size},
    {"ray_length", number, "-1", "not above 0: half the radius of a sphere around the scene"}};
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

constexpr Parameter kDropPaths{"strict_normals", boolean, "false",
                               "drop paths whose shading and geometric normals disagree"};
constexpr Parameter kAuto[] = {kMaxDepth, kRrDepth, kHideEmitters, kDropPaths};
constexpr Parameter kLightPaths{
    "light_paths", number, "0",
    "light sub-paths for each pixel; 0: 1/4 for bdpt and vcm, 1 for the others", not_negative};
constexpr Parameter kConnections{
    "connections", integer, "-1",
    "light vertices for each eye vertex; -1: those of one light sub-path", depth};

constexpr Parameter kPtracer[] = {
    kMaxDepth,
    kRrDepth,
    kHideEmitters,
    kLightPaths,
    {.name = "granularity", .type = integer, .versions = v0, .support = inert},
    {.name = "brute_force",
     .type = boolean,
     .preset = "false",
     .note = "connecting to the camera has the same mean",
     .versions = v0,
     .support = inert}};
constexpr Parameter kBdpt[] = {
    kMaxDepth,
    kRrDepth,
    kHideEmitters,
    kDropPaths,
    {"light_image", boolean, "true", "connect light vertices to the camera"},
    {.name = "sample_direct", .type = boolean, .support = inert},
    kLightPaths,
    kConnections};
constexpr Parameter kReuse[] = {
    {"max_depth", integer, "-1",
     "longest path in segments; -1: no limit, but max_eye_depth + max_light_depth + 1 with the "
     "weights of the thesis",
     depth},
    kRrDepth,
    kHideEmitters,
    kDropPaths,
    kLightPaths,
    {"max_eye_depth", integer, "4", "longest eye sub-path in segments", not_negative},
    {"max_light_depth", integer, "3", "longest light sub-path in segments", not_negative},
    {"weights", string, "exact", "exact, or those of the thesis, which are biased (docs/mis.md)"},
    {"thesis_reading", string, "b", "a or b, what the weights of the thesis are taken to mean"},
    {"continue_probability", number, "1", "that an eye sub-path goes on beyond its limit",
     probability}};

constexpr Parameter kRadius{
    .name = "radius",
    .type = number,
    .preset = "0",
    .note = "of merging in the first iteration, in world units; 0: from the size of a pixel",
    .range = not_negative,
    .aliases = "initial_radius"};
constexpr Parameter kRadiusAlpha{"alpha", number, "0",
                                 "how fast the radius shrinks; 0: the method's default", fraction};
constexpr Parameter kPpm[] = {
    kMaxDepth,
    {.name = "rr_depth",
     .type = integer,
     .preset = "5",
     .note = "where Russian roulette begins",
     .range = positive,
     .preset_0x = "3"},
    kHideEmitters,
    kDropPaths,
    kLightPaths,
    kRadius,
    {.name = "alpha",
     .type = number,
     .preset = "0",
     .note = "how fast the radius shrinks; 0: the method's default",
     .range = fraction,
     .preset_0x = "0.7"},
    {.name = "photon_count",
     .type = integer,
     .note = "light_paths decides",
     .versions = v0,
     .support = inert},
    {.name = "max_passes",
     .type = integer,
     .note = "the sampler's sample_count decides",
     .versions = v0,
     .support = inert},
    {.name = "granularity", .type = integer, .versions = v0, .support = inert}};
constexpr Parameter kPhotonmapper[] = {
    kMaxDepth,
    kRrDepth,
    kHideEmitters,
    {.name = "direct_samples", .type = integer, .support = inert},
    {.name = "glossy_samples", .type = integer, .support = inert},
    {.name = "global_photons", .type = integer, .support = inert},
    {.name = "caustic_photons", .type = integer, .support = inert},
    {.name = "volume_photons", .type = integer, .support = inert},
    {.name = "global_lookup_radius", .type = number, .support = inert},
    {.name = "caustic_lookup_radius", .type = number, .support = inert},
    {.name = "lookup_size", .type = integer, .support = inert},
    {.name = "granularity", .type = integer, .support = inert}};
constexpr Parameter kBpm[] = {kMaxDepth,   kRrDepth, kHideEmitters, kDropPaths,
                              kLightPaths, kRadius,  kRadiusAlpha};
constexpr Parameter kVcm[] = {kMaxDepth,   kRrDepth,     kHideEmitters, kDropPaths,
                              kLightPaths, kConnections, kRadius,       kRadiusAlpha};

constexpr Parameter kDepth[] = {{.name = "hide_emitters", .type = boolean, .support = inert}};
constexpr Parameter kAov[] = {
    {.name = "aovs",
     .type = string,
     .note =
         "name:kind, …; albedo depth position uv geo_normal sh_normal dp_du dp_dv "
         "prim_index shape_index, and duv_dx duv_dy, which are per pixel: Mitsuba 3.9.1 divides "
         "them by the square root of the sample count",
     .required = true},
    {.name = "hide_emitters", .type = boolean, .support = inert}};
constexpr Parameter kMoment[] = {{.name = "hide_emitters", .type = boolean, .support = inert}};

/// A parameter that the method run instead does not need.
constexpr Parameter without_effect(std::string_view name, ParameterType type) {
  return {.name = name, .type = type, .support = inert};
}
constexpr Parameter kPrbDepth{"max_depth", integer, "6", "longest path in segments; -1: no limit",
                              depth};
constexpr Parameter kPrb[] = {kPrbDepth, kRrDepth, kHideEmitters};
constexpr Parameter kPrbProjective[] = {kPrbDepth,
                                        kRrDepth,
                                        kHideEmitters,
                                        without_effect("sppc", integer),
                                        without_effect("sppp", integer),
                                        without_effect("sppi", integer),
                                        without_effect("guiding", string),
                                        without_effect("guiding_proj", boolean),
                                        without_effect("guiding_rounds", integer),
                                        without_effect("project_seed", string)};
constexpr Parameter kMlt[] = {kMaxDepth,
                              kRrDepth,
                              without_effect("direct_samples", integer),
                              without_effect("luminance_samples", integer),
                              without_effect("two_stage", boolean),
                              without_effect("bidirectional_mutation", boolean),
                              without_effect("lens_perturbation", boolean),
                              without_effect("multi_chain_perturbation", boolean),
                              without_effect("caustic_perturbation", boolean),
                              without_effect("manifold_perturbation", boolean),
                              without_effect("lambda", number)};
constexpr Parameter kErpt[] = {kMaxDepth,
                               kRrDepth,
                               without_effect("num_chains", number),
                               without_effect("max_chains", number),
                               without_effect("chain_length", integer),
                               without_effect("direct_samples", integer),
                               without_effect("lens_perturbation", boolean),
                               without_effect("multi_chain_perturbation", boolean),
                               without_effect("caustic_perturbation", boolean),
                               without_effect("manifold_perturbation", boolean),
                               without_effect("lambda", number)};
constexpr Parameter kPssmlt[] = {kMaxDepth,
                                 kRrDepth,
                                 without_effect("direct_samples", integer),
                                 without_effect("luminance_samples", integer),
                                 without_effect("two_stage", boolean),
                                 without_effect("bidirectional", boolean),
                                 without_effect("p_large", number)};
constexpr Parameter kVpl[] = {
    {"max_depth", integer, "5", "longest path in segments; -1: no limit", depth},
    {.name = "rr_depth", .type = integer, .preset = "5", .support = inert},
    without_effect("shadow_map_resolution", integer),
    without_effect("clamping", number)};
constexpr Parameter kIrrcache[] = {without_effect("resolution", integer),
                                   without_effect("quality", number),
                                   without_effect("gradients", boolean),
                                   without_effect("clamp_neighbor", boolean),
                                   without_effect("clamp_screen", boolean),
                                   without_effect("overture", boolean),
                                   without_effect("quality_adjustment", number),
                                   without_effect("indirect_only", boolean),
                                   without_effect("debug", boolean)};
constexpr Parameter kAdaptive[] = {without_effect("max_error", number),
                                   without_effect("max_sample_factor", integer),
                                   without_effect("p_value", number)};
constexpr Parameter kField[] = {
    {.name = "field",
     .type = string,
     .note = "position, distance, geoNormal, shNormal, uv, albedo, shapeIndex, primIndex",
     .required = true},
    {.name = "undefined", .type = number, .note = "0", .support = inert}};

const Plugin kIntegrators[] = {
    {"auto", both, kAuto, &read_auto,
     "Duet's own: whichever method suits the scene (docs/auto.md)"},
    {"path", both, kPath, &read_path},
    {"volpath", both, kVolpath, &read_volpath, "path tracing through participating media"},
    {"volpath_simple", v0, kVolpath, &read_volpath, "by volpath"},
    {"volpathmis", v3, kVolpathmis, &read_volpath, "by volpath, which has spectral MIS as well"},
    {"direct", both, kDirect, &read_direct},
    {"ptracer", both, kPtracer, &read_ptracer,
     "light tracing: paths from the lights, connected to the camera"},
    {"bdpt", v0, kBdpt, &read_bdpt, "bidirectional path tracing"},
    {"reuse", both, kReuse, &read_reuse,
     "Duet's own: bidirectional path tracing that reuses light sub-paths"},
    {"ppm", both, kPpm, &read_ppm,
     "Duet's own: progressive photon mapping; approximates that of 0.x"},
    {"bpm", both, kBpm, &read_bpm, "Duet's own: bidirectional photon mapping"},
    {"vcm", both, kVcm, &read_vcm, "Duet's own: vertex connection and merging"},
    {"sppm", v0, kPpm, &read_sppm, "by ppm", approximated},
    {"photonmapper", v0, kPhotonmapper, &read_photonmapper, "by ppm", approximated},
    {"depth", v3, kDepth, &read_depth},
    {"aov", v3, kAov, &read_aov, "may hold an integrator"},
    {"moment", v3, kMoment, &read_moment, "holds an integrator"},
    {"prb", v3, kPrb, &read_prb, "by path; no derivatives", approximated},
    {"prb_basic", v3, kPrb, &read_prb, "by path; no derivatives", approximated},
    {"prb_projective", v3, kPrbProjective, &read_prb, "by path; no derivatives", approximated},
    {"prbvolpath", v3, kPrb, &read_prbvolpath, "by volpath; no derivatives", approximated},
    {"direct_projective", v3, kPrbProjective, &read_direct_projective, "by direct; no derivatives",
     approximated},
    {"stokes",
     v3,
     {},
     &read_stokes,
     "by the integrator in it: light has no polarisation here",
     approximated},
    {"mlt", v0, kMlt, &read_metropolis, "by bdpt", approximated},
    {"erpt", v0, kErpt, &read_metropolis, "by bdpt", approximated},
    {"pssmlt", v0, kPssmlt, &read_metropolis, "by bdpt", approximated},
    {"vpl", v0, kVpl, &read_vpl, "by path", approximated},
    {"irrcache", v0, kIrrcache, &read_irrcache, "by the integrator in it", approximated},
    {"adaptive", v0, kAdaptive, &read_adaptive, "by the integrator in it", approximated},
    {"field", v0, kField, &read_field, "by aov", approximated},
    {"multichannel",
     v0,
     {},
     &read_multichannel,
     "holds one integrator that makes colours, and fields"},
    {"ao", v0, kOcclusion, &read_ao, "in Duet; Mitsuba 3 has none"},
    {.name = "motion",
     .versions = v0,
     .note = "ways of points between two frames are no light",
     .support = refused},
    {.name = "volprim_rf_basic",
     .versions = v3,
     .note = "radiance fields of volume primitives are not scenes of surfaces and media",
     .support = refused,
     .refused_parameters = "max_depth srgb_primitives"},
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
const Plugin kScenes[] = {{.name = "scene", .parameters = kScene}};

}  // namespace

std::span<const Plugin> integrators() {
  return kIntegrators;
}
std::span<const Plugin> scenes() {
  return kScenes;
}

}  // namespace duet::vocabulary
