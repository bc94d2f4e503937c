// The functions that the vocabulary names: each turns one plugin into a part of the description.
#pragma once

#include "mitsuba/vocabulary.h"

namespace duet {

// read_shapes.cpp
void read_mesh(SceneReader&, Properties&, ShapeDescription&);
void read_obj_shape(SceneReader&, Properties&, ShapeList&);
void read_rectangle(SceneReader&, Properties&, ShapeDescription&);
void read_cube(SceneReader&, Properties&, ShapeDescription&);
void read_sphere(SceneReader&, Properties&, ShapeDescription&);
void read_disk(SceneReader&, Properties&, ShapeDescription&);
void read_sdfgrid(SceneReader&, Properties&, ShapeDescription&);
void read_cylinder(SceneReader&, Properties&, ShapeDescription&);
void read_curves_shape(SceneReader&, Properties&, ShapeDescription&);
void read_hair_shape(SceneReader&, Properties&, ShapeDescription&);
void read_heightfield(SceneReader&, Properties&, ShapeDescription&);
void read_instance(SceneReader&, Properties&, ShapeDescription&);
void read_merge(SceneReader&, Properties&, ShapeList&);
void read_ellipsoids_shape(SceneReader&, Properties&, ShapeList&);
void read_shapegroup(SceneReader&, Properties&, ShapeGroupDescription&);

// read_lights.cpp
void read_area(SceneReader&, Properties&, AreaEmission&);
void read_point(SceneReader&, Properties&, LightDescription&);
void read_spot(SceneReader&, Properties&, LightDescription&);
void read_projector(SceneReader&, Properties&, LightDescription&);
void read_directional(SceneReader&, Properties&, LightDescription&);
void read_constant(SceneReader&, Properties&, LightDescription&);
void read_envmap(SceneReader&, Properties&, LightDescription&);
/// The transform of a light that shines along +z in this direction; nothing if it is zero.
std::optional<Matrix4> along(const std::array<double, 3>& direction);

// read_sky.cpp
void read_sky(SceneReader&, Properties&, LightDescription&);
void read_sun(SceneReader&, Properties&, LightDescription&);
void read_sunsky(SceneReader&, Properties&, LightDescription&);
void read_timed_sunsky(SceneReader&, Properties&, LightDescription&);
void read_collimated(SceneReader&, Properties&, LightDescription&);
void read_directionalarea(SceneReader&, Properties&, AreaEmission&);

// read_media.cpp
void read_homogeneous(SceneReader&, Properties&, MediumDescription&);
void read_heterogeneous(SceneReader&, Properties&, MediumDescription&);
void read_constvolume(SceneReader&, Properties&, MeantVolume&);
void read_gridvolume(SceneReader&, Properties&, MeantVolume&);
void read_volcache(SceneReader&, Properties&, MeantVolume&);

// read_phases.cpp
void read_isotropic(SceneReader&, Properties&, PhaseDescription&);
void read_hg(SceneReader&, Properties&, PhaseDescription&);
void read_rayleigh(SceneReader&, Properties&, PhaseDescription&);
void read_blendphase(SceneReader&, Properties&, PhaseDescription&);
void read_mixturephase(SceneReader&, Properties&, PhaseDescription&);
void read_sggx(SceneReader&, Properties&, PhaseDescription&);
void read_tabphase(SceneReader&, Properties&, PhaseDescription&);
void read_fibre_phase(SceneReader&, Properties&, PhaseDescription&);

// read_meters.cpp
void read_radiancemeter(SceneReader&, Properties&, SensorDescription&);
void read_irradiancemeter(SceneReader&, Properties&, SensorDescription&);
void read_fluencemeter(SceneReader&, Properties&, SensorDescription&);
void read_distant(SceneReader&, Properties&, SensorDescription&);
void read_spherical(SceneReader&, Properties&, SensorDescription&);
void read_telecentric(SceneReader&, Properties&, SensorDescription&);
void read_perspective_rdist(SceneReader&, Properties&, SensorDescription&);
void read_batch(SceneReader&, Properties&, SensorDescription&);

// read_sensors.cpp
void read_perspective(SceneReader&, Properties&, SensorDescription&);
void read_thinlens(SceneReader&, Properties&, SensorDescription&);
void read_orthographic(SceneReader&, Properties&, SensorDescription&);
void read_hdrfilm(SceneReader&, Properties&, FilmDescription&);
void read_mfilm(SceneReader&, Properties&, FilmDescription&);
void read_ldrfilm(SceneReader&, Properties&, FilmDescription&);
void read_filter(SceneReader&, Properties&, FilterDescription&);
void read_sampler(SceneReader&, Properties&, SamplerDescription&);

// read_integrators.cpp
void read_path(SceneReader&, Properties&, IntegratorDescription&);
void read_volpath(SceneReader&, Properties&, IntegratorDescription&);
void read_direct(SceneReader&, Properties&, IntegratorDescription&);
void read_depth(SceneReader&, Properties&, IntegratorDescription&);
void read_ao(SceneReader&, Properties&, IntegratorDescription&);
void read_aov(SceneReader&, Properties&, IntegratorDescription&);
void read_moment(SceneReader&, Properties&, IntegratorDescription&);

// read_substitutes.cpp: by another method
void read_prb(SceneReader&, Properties&, IntegratorDescription&);
void read_prbvolpath(SceneReader&, Properties&, IntegratorDescription&);
void read_direct_projective(SceneReader&, Properties&, IntegratorDescription&);
void read_metropolis(SceneReader&, Properties&, IntegratorDescription&);
void read_vpl(SceneReader&, Properties&, IntegratorDescription&);
void read_irrcache(SceneReader&, Properties&, IntegratorDescription&);
void read_adaptive(SceneReader&, Properties&, IntegratorDescription&);
void read_stokes(SceneReader&, Properties&, IntegratorDescription&);
void read_field(SceneReader&, Properties&, IntegratorDescription&);
void read_multichannel(SceneReader&, Properties&, IntegratorDescription&);

// read_bidirectional.cpp
void read_auto(SceneReader&, Properties&, IntegratorDescription&);
void read_ptracer(SceneReader&, Properties&, IntegratorDescription&);
void read_bdpt(SceneReader&, Properties&, IntegratorDescription&);
void read_reuse(SceneReader&, Properties&, IntegratorDescription&);
void read_ppm(SceneReader&, Properties&, IntegratorDescription&);
void read_sppm(SceneReader&, Properties&, IntegratorDescription&);
void read_photonmapper(SceneReader&, Properties&, IntegratorDescription&);
void read_bpm(SceneReader&, Properties&, IntegratorDescription&);
void read_vcm(SceneReader&, Properties&, IntegratorDescription&);

}  // namespace duet
