// Surfaces that shine.
#include <algorithm>

#include "math/angles.h"
#include "pbrt/emission.h"
#include "pbrt/light_values.h"
#include "pbrt/records.h"
#include "pbrt/vocabulary.h"

namespace duet::pbrt {

namespace {

using enum Status;

constexpr Spec kArea[] = {
    {"L", kColor, "1", "radiance"},
    {"twosided", kBoolean, "false"},
    {"filename", kString, "", "an image over the texture coordinates", 1, done, Versions::v4},
    {"scale", Types(kNumber | kColor), "1", "a colour in v3"},
    {"power", kNumber, "-1", "total power, instead of what the colour says", 1, done, Versions::v4},
    {"nsamples", kInteger, "1", "", 1, inert, Versions::v3},
    {"samples", kInteger, "1", "", 1, inert, Versions::v3}};

constexpr Record<int> kAreaLights[] = {
    {"diffuse", Versions::both, done, "", kArea, 1},
    {"area", Versions::v3, done, "", kArea, 1},
};

}  // namespace

Boxed<AreaEmission> read_area_light(Reader& reader, const Plugin& plugin,
                                    const std::function<double()>& area) {
  const auto* record = find_record<int>(reader, plugin, kAreaLights);
  if (!record) return {};
  Values v(reader, plugin, record->parameters);
  AreaEmission emission;
  emission.where = plugin.where;
  if (v.boolean("twosided")) emission.side = EmittingSide::both;
  Spectrum scale = scale_of(v);
  const double sides = emission.side == EmittingSide::both ? 2 : 1;
  const auto flux = [&] { return kPi * std::max(area(), 1e-30) * sides; };
  if (!v.has("filename")) {
    if (const auto power = positive_of(v, "power")) scale *= float(*power / flux());
    emission.radiance = emitted_color(v, "L") * scale;
    return emission;
  }
  if (v.has("L")) reader.report().error(v.where("L"), "a light has either \"L\" or a file");
  BitmapTexture image;
  image.file = v.file("filename");
  if (image.file.empty()) return {};
  image.colors = reader.image_colors(image.file, ColorMeaning::emission, v.where("filename"));
  scale_to_power(v, scale, image, [&](const TextureTexels& pixels) {
    return flux() * double(pixels.mean().luminance());
  });
  image.wrap_u = image.wrap_v = WrapMode::clamp;
  image.to_uv.m = {{{1, 0, 0}, {0, -1, 1}}};
  const TextureId texture = reader.add_texture(image, plugin.where);
  emission.radiance = reader.add_texture(ScaledTextureDescription{texture, scale}, plugin.where);
  return emission;
}

void list_area_lights(std::vector<Row>& rows) {
  list(rows, "AreaLightSource", kAreaLights);
}

}  // namespace duet::pbrt
