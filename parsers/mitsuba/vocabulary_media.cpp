#include "mitsuba/vocabulary_tables.h"

namespace duet::vocabulary {

namespace {

constexpr Plugin kMedia[] = {{.name = "homogeneous", .support = planned},
                             {.name = "heterogeneous", .support = planned}};

constexpr Plugin kPhases[] = {
    {.name = "isotropic", .support = planned},
    {.name = "hg", .support = planned},
    {.name = "rayleigh", .support = planned},
    {.name = "blendphase", .versions = v3, .support = planned},
    {.name = "sggx", .versions = v3, .support = planned},
    {.name = "tabphase", .versions = v3, .support = planned},
    {.name = "kkay", .versions = v0, .support = planned},
    {.name = "microflake", .versions = v0, .support = planned},
    {.name = "mixturephase", .versions = v0, .support = planned},
};

constexpr Plugin kVolumes[] = {
    {.name = "constvolume", .support = planned},
    {.name = "gridvolume", .support = planned},
    {.name = "hgridvolume", .versions = v0, .support = planned},
    {.name = "volcache", .versions = v0, .support = planned},
};

constexpr Plugin kSubsurfaces[] = {
    {.name = "dipole", .versions = v0, .support = planned},
    {.name = "singlescatter", .versions = v0, .support = planned},
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
