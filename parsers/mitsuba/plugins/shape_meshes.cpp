// Meshes from files.
#include "mitsuba/plugins/plugin.h"
#include "mitsuba/plugins/shapes.h"

namespace duet::plugins {

MeshOptions mesh_options(Properties& p, MeshSource& source) {
  source.plugin = p.node().plugin->name;
  source.face_normals = p.boolean("face_normals");
  MeshOptions options;
  options.face_normals = source.face_normals;
  options.flip_tex_coords = source.plugin != "serialized" && p.boolean("flip_tex_coords");
  source.flip_tex_coords = options.flip_tex_coords;
  options.max_smooth_angle = source.max_smooth_angle = p.optional_number("max_smooth_angle");
  if (options.face_normals && options.max_smooth_angle)
    p.error("max_smooth_angle", "both \"face_normals\" and \"max_smooth_angle\" are given");
  return options;
}

namespace {

void read_mesh(SceneReader& s, Properties& p, ShapeDescription& out) {
  MeshShape shape;
  shape.source->file = s.file(p, "filename");
  MeshOptions options = mesh_options(p, *shape.source);
  if (shape.source->plugin == "serialized")
    options.shape_index = shape.source->shape_index = p.integer("shape_index");
  if (!shape.source->file.empty())
    shape.mesh =
        s.cache().mesh(shape.source->plugin, shape.source->file, options, p.where("filename"));
  out.geometry = std::move(shape);
  s.attach_to_surface(p, out);
}

constexpr Parameter kMeshFile{.name = "filename", .type = file, .required = true};
constexpr Parameter kFaceNormals{"face_normals", boolean, "false",
                                 "faceted, without smooth normals"};
constexpr Parameter kSmoothAngle{
    "max_smooth_angle", number, "", "edges sharper than this (in degrees) stay sharp",
    not_negative,       v0};

Parameter flip_tex_coords(std::string_view preset) {
  return {"flip_tex_coords", boolean, preset, "turns v upside down"};
}

}  // namespace

Plugin obj() {
  constexpr Parameter parts[] = {
      {"load_materials", boolean, "true",
       "from the file's material library, unless the scene gives BSDFs", any, v0},
      {"collapse", boolean, "false",
       "the last material that the file uses is that of all its parts", any, v0},
      {"shape_index", integer, "", "only this part of the file", not_negative, v0},
      {"recenter", boolean, "false", "moves the middle of the box to the origin", any, v0}};
  return {"obj",
          both,
          {kMeshFile, kFaceNormals, flip_normals(), flip_tex_coords("true"), kSmoothAngle, parts},
          &read_obj_shape};
}

Plugin ply() {
  constexpr Parameter srgb{"srgb", boolean, "true", "", any, v0, ignored};
  return {"ply",
          both,
          {kMeshFile, kFaceNormals, flip_normals(), flip_tex_coords("false"), kSmoothAngle, srgb},
          &read_mesh};
}

Plugin serialized() {
  constexpr Parameter index{"shape_index", integer, "0", "which mesh of the file", not_negative};
  return {"serialized",
          both,
          {kMeshFile, index, kFaceNormals, flip_normals(), kSmoothAngle},
          &read_mesh};
}

}  // namespace duet::plugins
