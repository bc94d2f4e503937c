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

}  // namespace duet
