#include "mitsuba/readers.h"
#include "mitsuba/vocabulary_tables.h"

namespace duet::vocabulary {

namespace {

constexpr Parameter kFile{.name = "filename", .type = file, .required = true};
constexpr Parameter kFlipNormals{"flip_normals", boolean, "false", "turns the surface inside out"};
constexpr Parameter kFaceNormals{"face_normals", boolean, "false",
                                 "faceted, without smooth normals"};
/// These surfaces are flat anyway.
constexpr Parameter kFlatAnyway{.name = "face_normals", .type = boolean, .support = inert};
constexpr Parameter kSmoothAngle{.name = "max_smooth_angle",
                                 .type = number,
                                 .note = "edges sharper than this (in degrees) stay sharp",
                                 .range = not_negative,
                                 .versions = v0};

constexpr Parameter kObj[] = {
    kFile,
    kFaceNormals,
    kFlipNormals,
    {"flip_tex_coords", boolean, "true", "turns v upside down"},
    kSmoothAngle,
    {.name = "load_materials",
     .type = boolean,
     .preset = "true",
     .note = "the file's own materials are not used",
     .versions = v0,
     .support = approximated},
    {.name = "collapse", .type = boolean, .versions = v0, .support = inert},
    {.name = "shape_index", .type = integer, .versions = v0, .support = planned},
    {.name = "recenter", .type = boolean, .preset = "false", .versions = v0, .support = planned},
};
constexpr Parameter kPly[] = {
    kFile,
    kFaceNormals,
    kFlipNormals,
    {"flip_tex_coords", boolean, "false", "turns v upside down"},
    kSmoothAngle,
    {.name = "srgb", .type = boolean, .preset = "true", .versions = v0, .support = ignored},
};
constexpr Parameter kSerialized[] = {
    kFile,        {"shape_index", integer, "0", "which mesh of the file", not_negative},
    kFaceNormals, kFlipNormals,
    kSmoothAngle,
};
constexpr Parameter kFlat[] = {kFlipNormals, kFlatAnyway};
constexpr Parameter kDisk[] = {kFlipNormals};
constexpr Parameter kSphere[] = {
    {"center", point, "0 0 0"}, {"radius", number, "1", "", positive}, kFlipNormals};
constexpr Parameter kCylinder[] = {{"p0", point, "0 0 0"},
                                   {"p1", point, "0 0 1"},
                                   {"radius", number, "1", "", positive},
                                   kFlipNormals};

constexpr Parameter kSdfGrid[] = {
    {"filename", string, "", "a volume with one channel: distances"},
    {"normals", string, "smooth", "smooth or analytic, of shading"},
    kFlipNormals,
    {.name = "watertight",
     .type = boolean,
     .preset = "true",
     .note = "it always is",
     .support = inert},
    {.name = "grid", .type = string, .note = "only exists in Python", .support = refused},
};

constexpr Plugin kShapes[] = {
    {"obj", both, kObj, &read_mesh},
    {"ply", both, kPly, &read_mesh},
    {"serialized", both, kSerialized, &read_mesh},
    {"rectangle", both, kFlat, &read_rectangle},
    {"cube", both, kFlat, &read_cube},
    {"sphere", both, kSphere, &read_sphere},
    {"disk", both, kDisk, &read_disk},
    {"cylinder", both, kCylinder, &read_cylinder},
    {"sdfgrid", v3, kSdfGrid, &read_sdfgrid},
    {"shapegroup", both, {}, &read_shapegroup, "holds shapes"},
    {"instance", both, {}, &read_instance, "refers to a shapegroup"},
    planned_plugin("animatedinstance", v0, "filename to_world"),
    planned_plugin("blender", v3,
                   "name mesh verts loops loop_tris polys uvs cols face_normals flip_normals"),
    planned_plugin("bsplinecurve", v3,
                   "filename control_point_count control_points segment_indices to_world "
                   "silhouette_sampling_weight"),
    planned_plugin("deformable", v0, "filename"),
    planned_plugin("ellipsoids", v3,
                   "filename data centers scales quaternions scale_factor extent "
                   "extent_adaptive_clamping to_world"),
    planned_plugin("ellipsoidsmesh", v3,
                   "filename data centers scales quaternions scale_factor extent "
                   "extent_adaptive_clamping shell to_world"),
    planned_plugin("hair", v0, "filename radius angle_threshold reduction to_world"),
    planned_plugin("heightfield", v0, "to_world filename scale width height flip_normals"),
    planned_plugin("linearcurve", v3,
                   "filename control_point_count control_points segment_indices to_world "
                   "silhouette_sampling_weight"),
    planned_plugin("merge", v3),
};

}  // namespace

std::span<const Plugin> shapes() {
  return kShapes;
}

}  // namespace duet::vocabulary
