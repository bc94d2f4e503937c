#include "mitsuba/vocabulary_tables.h"

namespace duet::vocabulary {

namespace {

constexpr Plugin kMedia[] = {
    {.name = "homogeneous",
     .support = planned,
     .planned_parameters = "albedo sigma_t sigma_a sigma_s scale material sample_emitters "
                           "has_spectral_extinction strategy"},
    {.name = "heterogeneous",
     .support = planned,
     .planned_parameters = "albedo sigma_t density orientation method scale sample_emitters "
                           "has_spectral_extinction"}};

constexpr Plugin kPhases[] = {
    {.name = "isotropic", .support = planned},
    {.name = "hg", .support = planned, .planned_parameters = "g"},
    {.name = "rayleigh", .support = planned},
    {.name = "blendphase", .versions = v3, .support = planned, .planned_parameters = "weight"},
    {.name = "sggx", .versions = v3, .support = planned, .planned_parameters = "S"},
    {.name = "tabphase", .versions = v3, .support = planned, .planned_parameters = "values"},
    {.name = "kkay", .versions = v0, .support = planned, .planned_parameters = "ks kd exponent"},
    {.name = "microflake", .versions = v0, .support = planned, .planned_parameters = "stddev"},
    {.name = "mixturephase", .versions = v0, .support = planned, .planned_parameters = "weights"},
};

constexpr Plugin kVolumes[] = {
    {.name = "constvolume", .support = planned, .planned_parameters = "value to_world"},
    {.name = "gridvolume",
     .support = planned,
     .planned_parameters = "filename grid data filter_type wrap_mode raw accel use_grid_bbox "
                           "max_value to_world min max send_data"},
    {.name = "hgridvolume",
     .versions = v0,
     .support = planned,
     .planned_parameters = "filename prefix postfix to_world"},
    {.name = "volcache",
     .versions = v0,
     .support = planned,
     .planned_parameters = "cache_size voxel_width block_size"},
};

constexpr Plugin kSubsurfaces[] = {
    {.name = "dipole",
     .versions = v0,
     .support = planned,
     .planned_parameters =
         "material sigma_s sigma_a sigma_t albedo int_ior ext_ior scale irr_samples quality"},
    {.name = "singlescatter",
     .versions = v0,
     .support = planned,
     .planned_parameters =
         "fast_single_scatter fast_single_scatter_samples single_scatter_shadow_rays "
         "single_scatter_transmittance single_scatter_depth"},
};

}  // namespace

std::span<const Plugin> media() {
  return kMedia;
}
std::span<const Plugin> phases() {
  return kPhases;
}
std::span<const Plugin> volumes() {
  return kVolumes;
}
std::span<const Plugin> subsurfaces() {
  return kSubsurfaces;
}

}  // namespace duet::vocabulary
