#include "mitsuba/vocabulary_tables.h"

namespace duet::vocabulary {

namespace {

constexpr Plugin kMedia[] = {
    planned_plugin("homogeneous", both,
                   "albedo sigma_t sigma_a sigma_s scale material sample_emitters "
                   "has_spectral_extinction strategy"),
    planned_plugin("heterogeneous", both,
                   "albedo sigma_t density orientation method scale sample_emitters "
                   "has_spectral_extinction")};

constexpr Plugin kPhases[] = {
    planned_plugin("isotropic", both),
    planned_plugin("hg", both, "g"),
    planned_plugin("rayleigh", both),
    planned_plugin("blendphase", v3, "weight"),
    planned_plugin("sggx", v3, "S"),
    planned_plugin("tabphase", v3, "values"),
    planned_plugin("kkay", v0, "ks kd exponent"),
    planned_plugin("microflake", v0, "stddev"),
    planned_plugin("mixturephase", v0, "weights"),
};

constexpr Plugin kVolumes[] = {
    planned_plugin("constvolume", both, "value to_world"),
    planned_plugin("gridvolume", both,
                   "filename grid data filter_type wrap_mode raw accel use_grid_bbox "
                   "max_value to_world min max send_data"),
    planned_plugin("hgridvolume", v0, "filename prefix postfix to_world"),
    planned_plugin("volcache", v0, "cache_size voxel_width block_size"),
};

constexpr Plugin kSubsurfaces[] = {
    planned_plugin(
        "dipole", v0,
        "material sigma_s sigma_a sigma_t albedo int_ior ext_ior scale irr_samples quality"),
    planned_plugin("singlescatter", v0,
                   "fast_single_scatter fast_single_scatter_samples single_scatter_shadow_rays "
                   "single_scatter_transmittance single_scatter_depth"),
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
