// Shapes.
#include "mitsuba/plugins/shapes.h"

#include <cmath>

#include "mitsuba/plugins/shape.h"
#include "mitsuba/plugins/tables.h"
#include "mitsuba/unstretched.h"
#include "values/text.h"
#include "volume/surface_grid.h"
#include "volume/volume_file.h"
#include "xml/value_elements.h"

namespace duet::plugins {

namespace {

void read_sdfgrid(SceneReader& s, Properties& p, ShapeDescription& out) {
  enum class Normals { smooth, analytic };
  const auto normals =
      p.choice<Normals>("normals", {{"smooth", Normals::smooth}, {"analytic", Normals::analytic}});
  const std::string file = s.file(p, "filename");
  s.attach_to_surface(p, out);
  if (out.emission)
    s.report().error(out.emission->where, "{} cannot emit light", describe(p.node()));
  if (file.empty()) return;
  const SourceLocation where = p.where("filename");
  if (is_nanovdb(file)) return p.error("filename", "a grid of distances is a .vol file");
  bool is_float32;
  const auto volume = s.cache().volume_grid(file, where, is_float32);
  if (!volume) return;
  auto grid = s.report().from_file(where, [&] { return surface_of(*volume, in_quotes(file)); });
  if (!grid) return;
  grid->smooth_normals = normals == Normals::smooth;
  out.geometry = SdfGridShape{std::make_shared<SdfGrid>(std::move(*grid)), file};
}

/// The radius of a sphere or cylinder. In Mitsuba 3 it scales, so that a negative one turns the
/// surface around.
double quadric_radius(Properties& p) {
  const double r = p.number("radius");
  if (r > 0 || (r < 0 && !p.is_0x())) return r;
  if (p.is_0x())
    p.error("radius", "the parameter \"radius\" of {} must be positive, not {}", describe(p.node()),
            r);
  else
    p.error("radius", "the parameter \"radius\" of {} must be other than 0", describe(p.node()));
  return 1;
}

void read_sphere(SceneReader& s, Properties& p, ShapeDescription& out) {
  out.geometry = SphereShape{};
  Triple c = p.triple("center");
  const double r = quadric_radius(p);
  s.attach_to_surface(p, out);
  Matrix4 m = out.to_world;
  if (p.is_0x() && out.motion.empty()) {
    // Mitsuba 0.x takes the scale out before it places the centre, and leaves the normals of
    // mirrored spheres as they are.
    const Triple x = m.turned({1, 0, 0});
    for (double& v : c) v /= std::hypot(x[0], x[1], x[2]);
    if (m.determinant3() < 0) out.flip_normals = !out.flip_normals;
  }
  m = m * Matrix4::translate(c[0], c[1], c[2]);
  if (const auto round = unstretched(m)) {
    s.report().warning(p.where("to_world"),
                       "spheres stay round in Mitsuba: the radius of this one is scaled as its x "
                       "axis is, and the rest of the transform only turns and moves it");
    m = *round;
  }
  out.to_world = m * Matrix4::scale(r, r, r);
}

void read_cylinder(SceneReader& s, Properties& p, ShapeDescription& out) {
  out.geometry = CylinderShape{};
  const Triple p0 = p.triple("p0"), p1 = p.triple("p1");
  const double radius = quadric_radius(p);
  Triple d{p1[0] - p0[0], p1[1] - p0[1], p1[2] - p0[2]};
  const double length = std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
  if (!(length > 0)) {
    p.error("p1", "the ends \"p0\" and \"p1\" of the cylinder are the same point");
    return;
  }
  for (double& v : d) v /= length;
  // The seam of the surface lies where Mitsuba puts it.
  const Triple u = orthogonal_vector(d, p.node().version);
  Matrix4 frame;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    frame[i] = {u[i] * radius, (d[j] * u[k] - d[k] * u[j]) * radius, d[i] * length, p0[i]};
  }
  out.to_world = frame;
  s.attach_to_surface(p, out);
}

/// Curves, whose faces cannot be turned; `read` reads the file, if there is one.
template <class Read>
void set_curves(SceneReader& s, Properties& p, const std::string& file, Read read,
                ShapeDescription& out) {
  s.attach_to_surface(p, out);
  if (out.emission)
    s.report().error(out.emission->where, "{} cannot emit light", describe(p.node()));
  if (file.empty()) return;
  if (auto curves = s.report().from_file(p.where("filename"), read))
    out.geometry = CurvesShape{std::make_shared<CurveSet>(std::move(*curves)), file};
}

void read_curves_shape(SceneReader& s, Properties& p, ShapeDescription& out) {
  const CurveKind kind =
      p.node().plugin->name == "bsplinecurve" ? CurveKind::bspline : CurveKind::linear;
  const std::string file = s.file(p, "filename");
  set_curves(
      s, p, file, [&] { return s.files().read_curves(file, kind); }, out);
}

void read_hair_shape(SceneReader& s, Properties& p, ShapeDescription& out) {
  const std::string file = s.file(p, "filename");
  const double reduction = p.number("reduction");
  // Which hairs are culled is random in Mitsuba 0.6; all of them look as they should.
  const double radius = p.number("radius");
  if (reduction > 0)
    s.approximate_loudly(p.where("reduction"), "no hair is left out: \"reduction\" is ignored");
  s.approximate(p.node().where, "the joints of hair are spheres, not mitres");
  set_curves(
      s, p, file, [&] { return s.files().read_hair(file, float(radius)); }, out);
}

void read_instance(SceneReader& s, Properties& p, ShapeDescription& out) {
  out.to_world = p.transform("to_world", out.motion);
  const Node* node = p.child(PluginKind::shape);
  if (!node) return p.needs("a reference to a shape group");
  if (!node->plugin) return;
  if (!std::holds_alternative<ReadInto<ShapeGroupDescription>>(node->plugin->reader))
    return p.needs("a shape group, not {}", describe(*node));
  if (const auto group = s.shape_group(*node)) out.geometry = InstanceShape{*group};
}

void read_shapegroup(SceneReader& s, Properties& p, ShapeGroupDescription& out) {
  for (const Properties::Child& child : p.children(PluginKind::shape))
    s.shape(*child.node, out.shapes, true);
}

void read_heightfield(SceneReader& s, Properties& p, ShapeDescription& out) {
  HeightFieldShape field;
  read_values(s, p, field);
  const int width = p.integer("width"), height = p.integer("height");
  // Mitsuba 0.6 does not listen to one of them alone.
  if (p.has("width") && p.has("height")) field.width = width, field.height = height;
  if (const Node* filter = p.child(PluginKind::rfilter)) s.read_into(*filter, *field.filter);
  const auto textures = p.children(PluginKind::texture);
  s.attach_to_surface(p, out);
  if (textures.size() + (p.has("filename") ? 1 : 0) != 1)
    return p.needs("one image: a \"filename\" or a texture");
  if (!textures.empty()) {
    const auto heights = s.texture(*textures[0].node);
    if (!heights) return;
    field.heights = *heights;
  } else {
    const std::string file = s.file(p, "filename");
    if (file.empty()) return;
    auto& all = s.description().textures;
    field.heights = TextureId{uint32_t(all.size())};
    BitmapTexture image;
    image.file = file;
    all.push_back({p.where("filename"), {}, image});
  }
  out.geometry = field;
}

}  // namespace

Parameter flip_normals() {
  return {"flip_normals", boolean, "false", "turns the surface inside out"};
}

namespace {

Plugin hair_shape() {
  constexpr Parameter threshold{
      "angle_threshold", number, "1", "nothing is simplified", any, both, inert};
  constexpr Parameter reduction{"reduction", number, "0",         "all hairs stay",
                                fraction,    both,   approximated};
  return {"hair",
          v0,
          {Parameter{.name = "filename", .type = file, .note = "text or binary", .required = true},
           Parameter{"radius", number, "0.025", "in world space", positive}, threshold, reduction},
          &read_hair_shape,
          "segments meet in spheres; cannot emit light"};
}

Plugin heightfield() {
  constexpr Parameter image{"filename", file, "", "an image: its luminance is the height"};
  return {"heightfield",
          v0,
          {image, parameters_of<HeightFieldShape>(), flip_normals()},
          &read_heightfield,
          "a triangle mesh; may hold a texture (bitmap, checkerboard, gridtexture or scale of one) "
          "instead of naming an image, and a reconstruction filter"};
}

}  // namespace

std::vector<Plugin> shapes() {
  const Parameter flip = flip_normals();
  // These surfaces are flat anyway.
  const ParameterList flat(flip, inert_parameters(boolean, "face_normals"));
  constexpr Parameter watertight{"watertight", boolean, "true", "it always is", any, both, inert};
  constexpr Parameter grid{"grid", string, "", "only exists in Python", any, both, refused};
  return {
      obj(),
      ply(),
      serialized(),
      surface<RectangleShape>(flat),
      surface<CubeShape>(flat),
      {"sphere",
       both,
       {Parameter{"center", point, "0 0 0"},
        Parameter{"radius", number, "1", "in 3.x a negative one turns the normals"}, flip},
       &read_sphere},
      surface<DiskShape>(flip),
      {"cylinder",
       both,
       {Parameter{"p0", point, "0 0 0"}, Parameter{"p1", point, "0 0 1"},
        Parameter{"radius", number, "1", "in 3.x also a negative one"}, flip},
       &read_cylinder},
      {"sdfgrid",
       v3,
       {parameters_of<SdfGridShape>(),
        Parameter{"normals", string, "smooth", "smooth or analytic, of shading"}, flip, watertight,
        grid},
       &read_sdfgrid},
      {.name = "shapegroup", .reader = &read_shapegroup, .note = "holds shapes"},
      {.name = "instance", .reader = &read_instance, .note = "refers to a shapegroup"},
      refused_plugin(
          "animatedinstance", v0,
          "its tracks are a binary file of 0.4 or earlier: use an instance with an animation",
          "filename to_world"),
      refused_plugin("blender", v3, "only exists within Blender",
                     "name mesh verts loops loop_tris polys uvs cols face_normals flip_normals"),
      {"bsplinecurve", v3, parameters_of<CurvesShape>(), &read_curves_shape,
       "cannot emit light; dp_dv is that of uv, where Mitsuba's twists as the curve's torsion "
       "does"},
      refused_plugin("deformable", v0, "shapes move, but keep their form: use a mesh", "filename"),
      ellipsoids(),
      ellipsoidsmesh(),
      hair_shape(),
      heightfield(),
      {"linearcurve", v3, parameters_of<CurvesShape>(), &read_curves_shape, "cannot emit light"},
      merge(),
  };
}

}  // namespace duet::plugins
