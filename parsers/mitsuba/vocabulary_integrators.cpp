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
     .note = "name:kind, …; albedo depth position uv geo_normal sh_normal dp_du dp_dv duv_dx "
             "duv_dy prim_index shape_index",
     .required = true},
    {.name = "hide_emitters", .type = boolean, .support = inert}};
constexpr Parameter kMoment[] = {{.name = "hide_emitters", .type = boolean, .support = inert}};

constexpr Plugin kIntegrators[] = {
    {"path", both, kPath, &read_path},
    {"direct", both, kDirect, &read_direct},
    {"depth", v3, kDepth, &read_depth},
    {"aov", v3, kAov, &read_aov, "may hold an integrator"},
    {"moment", v3, kMoment, &read_moment, "holds an integrator"},
    {.name = "adaptive", .versions = v0, .support = planned},
    {.name = "ao", .versions = v0, .support = planned},
    {.name = "bdpt", .versions = v0, .support = planned},
    {.name = "erpt", .versions = v0, .support = planned},
    {.name = "field", .versions = v0, .support = planned},
    {.name = "irrcache", .versions = v0, .support = planned},
    {.name = "mlt", .versions = v0, .support = planned},
    {.name = "motion", .versions = v0, .support = planned},
    {.name = "multichannel", .versions = v0, .support = planned},
    {.name = "photonmapper", .versions = v0, .support = planned},
    {.name = "ppm", .versions = v0, .support = planned},
    {.name = "prb", .versions = v3, .support = planned},
    {.name = "prb_basic", .versions = v3, .support = planned},
    {.name = "prbvolpath", .versions = v3, .support = planned},
    {.name = "pssmlt", .versions = v0, .support = planned},
    {.name = "ptracer", .support = planned},
    {.name = "sppm", .versions = v0, .support = planned},
    {.name = "stokes", .versions = v3, .support = planned},
    {.name = "vcm", .versions = v0, .support = planned},
    {.name = "volpath", .support = planned},
    {.name = "volpath_simple", .versions = v0, .support = planned},
    {.name = "volpathmis", .versions = v3, .support = planned},
    {.name = "vpl", .versions = v0, .support = planned},
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
