// Where on a texture a point of a surface lies.
#include "pbrt/texture_readers.h"
#include "values/text.h"

namespace duet::pbrt {

Matrix4 from_world(Values& v) {
  const Matrix4& ctm = v.reader().state().ctm[0];
  if (!v.reader().check_transform(ctm, v.where())) return {};
  return *ctm.inverse();
}

UvTransform mapping(Values& v) {
  UvTransform m;
  const std::string kind = v.string("mapping");
  if (kind == "uv")
    m.m = {
        {{v.number("uscale"), 0, v.number("udelta")}, {0, v.number("vscale"), v.number("vdelta")}}};
  else if (kind != "spherical" && kind != "cylindrical" && kind != "planar")
    v.reader().report().warning(v.where("mapping"),
                                "there is no mapping {}; the surface's coordinates are taken as "
                                "they are, as in pbrt",
                                in_quotes(kind));
  return m;
}

TextureId mapped(Values& v, TextureId texture) {
  const std::string kind = v.string("mapping");
  MappedTextureDescription m;
  m.inner = texture;
  m.from_world = from_world(v);
  if (kind == "spherical") {
    m.kind = SpaceMapKind::spherical;
  } else if (kind == "cylindrical") {
    m.kind = SpaceMapKind::cylindrical;
  } else if (kind == "planar") {
    m.kind = SpaceMapKind::planar;
    const auto a = v.point("v1"), b = v.point("v2");
    // The third coordinate is not looked at, but files have only transforms with an inverse.
    Matrix4 plane;
    plane.m = {
        {{a[0], a[1], a[2], v.number("udelta")},
         {b[0], b[1], b[2], v.number("vdelta")},
         {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0], 0},
         {0, 0, 0, 1}}};
    m.from_world = plane * m.from_world;
  } else {
    return texture;
  }
  return v.reader().add_texture(m, v.where());
}

}  // namespace duet::pbrt
