// What the files about shapes share.
#pragma once

#include "mitsuba/scene_reader.h"

namespace duet::plugins {

// shape_meshes.cpp
Plugin obj();
Plugin ply();
Plugin serialized();
// shape_lists.cpp
Plugin merge();
Plugin ellipsoids();
Plugin ellipsoidsmesh();

/// Reads an OBJ file, whose parts may have different materials (read_obj.cpp).
void read_obj_shape(SceneReader& s, Properties& p, ShapeList& out);
/// The parameters that all mesh files have; `source` gets them, too.
MeshOptions mesh_options(Properties& p, MeshSource& source);

/// Turns a surface inside out.
Parameter flip_normals();

}  // namespace duet::plugins
