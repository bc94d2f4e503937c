// The BSDFs of Mitsuba that mean more than their fields say: each function makes the row of one
// plugin, together with how it is read.
#pragma once

#include "mitsuba/vocabulary.h"

namespace duet::plugins {

/// All of them, in the order in which they are listed.
std::vector<Plugin> bsdfs();

// bsdf_conductor.cpp
Plugin conductor();
Plugin roughconductor();
// bsdf_principled.cpp
Plugin principled();
// bsdf_adapters.cpp
Plugin twosided();
Plugin mixturebsdf();
// bsdf_maps.cpp
Plugin bumpmap();
Plugin normalmap();
// bsdf_two_lobes.cpp
Plugin phong();
Plugin ward();
// bsdf_irawan.cpp
Plugin irawan();
// bsdf_filters.cpp
Plugin circular();
Plugin polarizer();
Plugin retarder();
// bsdf_coating.cpp
Plugin coating();
Plugin roughcoating();
// bsdf_hair.cpp
Plugin hair();
// bsdf_measured.cpp
Plugin measured();
Plugin measured_polarized();
// bsdf_pplastic.cpp
Plugin pplastic();
// bsdf_medium.cpp
Plugin hk();
Plugin sssbrdf();

}  // namespace duet::plugins
