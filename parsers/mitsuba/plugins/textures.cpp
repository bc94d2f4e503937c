
#include <algorithm>

#include "mitsuba/plugins/plugin.h"
#include "mitsuba/plugins/tables.h"
#include "values/text.h"

namespace duet::plugins {

namespace {

void check_checkerboard(SceneReader&, Properties& p, CheckerboardTexture& t) {
  t.swap_values = !p.is_0x();
}

void check_mesh_attribute(SceneReader&, Properties& p, MeshAttributeTexture& t) {
  if (p.has("name") && !t.attribute.starts_with("vertex_") && !t.attribute.starts_with("face_"))
    p.error("name", "the name of a mesh attribute begins with \"vertex_\" or \"face_\", unlike {}",
            in_quotes(t.attribute));
}

void read_vertexcolors(SceneReader&, Properties&, TextureDescription& out) {
  out.model = MeshAttributeTexture{"vertex_color", 1};
}

void check_wireframe(SceneReader&, Properties&, WireframeTexture& t) {
  if (t.line_width == 0.0) t.line_width.reset();
  t.step_width = std::clamp(t.step_width, 0.0, 1.0);
}

}  // namespace

std::vector<Plugin> textures() {
  constexpr const char *kPbrt = "Duet's own, that of pbrt",
                       *kInSpace = "Duet's own, that of pbrt; looked up in the world";
  const std::vector<Plugin> of_coordinates{
      bitmap(),
      texture<CheckerboardTexture, check_checkerboard>(),
      texture<MeshAttributeTexture, check_mesh_attribute>({.versions = v3}),
      {.name = "vertexcolors", .versions = v0, .reader = &read_vertexcolors},
      texture<ScaledTextureDescription>({.versions = v0, .note = "holds a texture"}),
  };
  const std::vector<Plugin> others{
      texture<VolumeTextureDescription>({.versions = v3, .note = "looked up in the world"}),
      texture<GridLinesTexture>({.versions = v0}),
      texture<CurvatureTexture>(
          {.versions = v0,
           .note = "not on curves; instances show that of the shape before it is placed"}),
      texture<WireframeTexture, check_wireframe>(
          {.versions = v0,
           .note =
               "on meshes and cubes, other shapes are all interior; instances show the lines of "
               "the mesh before it is placed"}),
      texture<BilerpDescription>({.note = kPbrt}),
      texture<DirectionMixDescription>({.note = kPbrt}),
      texture<DotsDescription>({.note = kPbrt}),
      texture<FunctionDescription>({.note = "Duet's own; holds a texture"}),
      texture<MappedTextureDescription>(
          {.note = "Duet's own; holds a texture that is looked up by a mapping of the world"}),
      texture<MixDescription>({.note = kPbrt}),
      texture<NoiseTextureDescription>({.note = kInSpace}),
      texture<ProductDescription>({.note = "Duet's own, pbrt's `scale`"}),
      texture<SolidCheckerboardDescription>({.note = kInSpace}),
  };
  return joined({of_coordinates, spectra(), others});
}

}  // namespace duet::plugins
