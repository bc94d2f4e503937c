// The BSDFs of Mitsuba that mean more than their fields say: each function makes the row of one
// plugin, together with how it is read, or checks what the fields say.
#pragma once

#include "mitsuba/vocabulary.h"

namespace duet::plugins {

/// All of them, in the order in which they are listed.
std::vector<Plugin> bsdfs();

// bsdf_conductor.cpp
Plugin conductor();
Plugin roughconductor();
// bsdf_adapters.cpp
Plugin twosided();
Plugin mixturebsdf();
// bsdf_maps.cpp
Plugin bumpmap();
Plugin normalmap();
// bsdf_irawan.cpp
Plugin irawan();
// bsdf_filters.cpp
Plugin circular();
Plugin polarizer();
Plugin retarder();
// bsdf_measured.cpp
Plugin measured();
// bsdf_medium.cpp
Plugin hk();
Plugin sssbrdf();

// bsdf_checks.cpp
void check_phong(SceneReader& s, Properties& p, PhongMaterial& m);
void check_ward(SceneReader& s, Properties& p, WardMaterial& m);
bool check_coating(SceneReader& s, Properties& p, CoatingMaterial& m);
void check_hair(SceneReader& s, Properties& p, HairMaterial& m);
void check_pplastic(SceneReader& s, Properties& p, PolarizedPlasticMaterial& m);
void check_principled(SceneReader& s, Properties& p, PrincipledMaterial& m);
/// Mitsuba 0.6 scales the two lobes of a material that would reflect more light than there is; with
/// a warning.
void conserve_energy(SceneReader& s, Properties& p, ColorInput& diffuse, ColorInput& specular);

}  // namespace duet::plugins
