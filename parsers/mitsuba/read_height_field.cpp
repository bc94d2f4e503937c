// Surfaces of heights.
#include "mitsuba/readers.h"
#include "mitsuba/scene_reader.h"

namespace duet {

void read_heightfield(SceneReader& s, Properties& p, ShapeDescription& out) {
  HeightFieldShape field;
  field.scale = p.number("scale");
  const int width = p.integer("width"), height = p.integer("height");
  // Mitsuba 0.6 does not listen to one of them alone.
  if (p.has("width") && p.has("height")) field.width = width, field.height = height;
  field.shading_normals = p.boolean("shading_normals");
  if (const Node* filter = p.child(PluginKind::rfilter)) s.read_into(*filter, field.filter);
  const auto textures = p.children(PluginKind::texture);
  s.attach_to_surface(p, out);
  if (textures.size() + (p.has("filename") ? 1 : 0) != 1)
    return s.report().error(p.node().where, "{} needs one image: a \"filename\" or a texture",
                            describe(p.node()));
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

}  // namespace duet
