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
     .note = "from the file's material library, unless the scene gives BSDFs",
     .versions = v0},
    {.name = "collapse",
     .type = boolean,
     .preset = "false",
     .note = "the last material that the file uses is that of all its parts",
     .versions = v0},
    {.name = "shape_index",
     .type = integer,
     .note = "only this part of the file",
     .range = not_negative,
     .versions = v0},
    {.name = "recenter",
     .type = boolean,
     .preset = "false",
     .note = "moves the middle of the box to the origin",
     .versions = v0},
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
constexpr Parameter kSphere[] = {{"center", point, "0 0 0"},
                                 {"radius", number, "1", "in 3.x a negative one turns the normals"},
                                 kFlipNormals};
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

constexpr Parameter kCurves[] = {
    {.name = "filename",
     .type = file,
     .note = "a point and a radius per line, an empty line between curves",
     .required = true},
};
constexpr Parameter kEllipsoidFile{
    .name = "filename", .type = file, .note = "a PLY file", .required = true};
constexpr Parameter kScaleFactor{"scale_factor", number, "1", "multiplies the radii", positive};
constexpr Parameter kExtent{"extent", number, "3", "multiplies the radii too", positive};
constexpr Parameter kClamping{.name = "extent_adaptive_clamping",
                              .type = boolean,
                              .note = "these are surfaces here",
                              .support = refused};
constexpr const char* kPythonOnly = "only exists in Python";
constexpr Parameter kData{.name = "data", .type = string, .note = kPythonOnly, .support = refused};
constexpr Parameter kCenters{
    .name = "centers", .type = string, .note = kPythonOnly, .support = refused};
constexpr Parameter kScales{
    .name = "scales", .type = string, .note = kPythonOnly, .support = refused};
constexpr Parameter kQuaternions{
    .name = "quaternions", .type = string, .note = kPythonOnly, .support = refused};
constexpr Parameter kEllipsoids[] = {kEllipsoidFile, kScaleFactor, kExtent, kClamping,
                                     kData,          kCenters,     kScales, kQuaternions};
constexpr Parameter kEllipsoidsMesh[] = {kEllipsoidFile,
                                         kScaleFactor,
                                         kExtent,
                                         kClamping,
                                         {.name = "shell",
                                          .type = string,
                                          .note = "ellipsoids are exact, not meshes",
                                          .support = approximated},
                                         kData,
                                         kCenters,
                                         kScales,
                                         kQuaternions};
constexpr Parameter kHeightField[] = {
    {.name = "filename", .type = file, .note = "an image: its luminance is the height"},
    {"scale", number, "1", "multiplies the heights"},
    {"width", integer, "32", "columns of a texture that is no image, with height", size},
    {"height", integer, "32", "rows of a texture that is no image, with width", size},
    {"shading_normals", boolean, "true", "smooth, not those of each bilinear patch"},
    kFlipNormals,
};
constexpr Parameter kHair[] = {
    {.name = "filename", .type = file, .note = "text or binary", .required = true},
    {"radius", number, "0.025", "in world space", positive},
    {.name = "angle_threshold",
     .type = number,
     .preset = "1",
     .note = "nothing is simplified",
     .support = inert},
    {.name = "reduction",
     .type = number,
     .preset = "0",
     .note = "all hairs stay",
     .range = fraction,
     .support = approximated},
};

const Plugin kShapes[] = {
    {"obj", both, kObj, &read_obj_shape},
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
    {.name = "animatedinstance",
     .versions = v0,
     .note = "its tracks are a binary file of 0.4 or earlier: use an instance with an animation",
     .support = refused,
     .refused_parameters = "filename to_world"},
    {.name = "blender",
     .versions = v3,
     .note = "only exists within Blender",
     .support = refused,
     .refused_parameters =
         "name mesh verts loops loop_tris polys uvs cols face_normals flip_normals"},
    {"bsplinecurve", v3, kCurves, &read_curves_shape,
     "cannot emit light; dp_dv is that of uv, where Mitsuba's twists as the curve's torsion does"},
    {.name = "deformable",
     .versions = v0,
     .note = "shapes move, but keep their form: use a mesh",
     .support = refused,
     .refused_parameters = "filename"},
    {"ellipsoids", v3, kEllipsoids, &read_ellipsoids_shape,
     "from files, without attributes and texture coordinates; cannot emit light"},
    {"ellipsoidsmesh", v3, kEllipsoidsMesh, &read_ellipsoids_shape, "as ellipsoids", approximated},
    {"hair", v0, kHair, &read_hair_shape, "segments meet in spheres; cannot emit light"},
    {"heightfield", v0, kHeightField, &read_heightfield,
     "a triangle mesh; may hold a texture (bitmap, checkerboard, gridtexture or scale of one) "
     "instead of naming an image, and a reconstruction filter"},
    {"linearcurve", v3, kCurves, &read_curves_shape, "cannot emit light"},
    {"merge", v3, {}, &read_merge, "holds shapes, which stay as they are"},
};

}  // namespace

std::span<const Plugin> shapes() {
  return kShapes;
}

}  // namespace duet::vocabulary
