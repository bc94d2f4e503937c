// Lights.
#include <cmath>

#include "math/angles.h"
#include "pbrt/emission.h"
#include "pbrt/light_values.h"
#include "pbrt/records.h"
#include "pbrt/values.h"
#include "pbrt/vocabulary.h"

namespace duet::pbrt {

namespace {

using enum Status;

/// From the space where the light sits at the origin and shines along +z.
Matrix4 aimed(const std::array<double, 3>& from, const std::array<double, 3>& to) {
  std::array<double, 3> d;
  for (size_t i = 0; i < 3; ++i) d[i] = to[i] - from[i];
  const bool along_y = std::abs(d[1]) > 0.9 * std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
  const std::array<double, 3> up =
      along_y ? std::array<double, 3>{1, 0, 0} : std::array<double, 3>{0, 1, 0};
  return Matrix4::look_at(from, to, up).value_or(Matrix4{});
}

bool differ(Values& v) {
  if (v.point("from") != v.point("to")) return true;
  v.reader().report().error(v.where(), "\"from\" and \"to\" are the same point");
  return false;
}

void add_placed(Values& v, decltype(LightDescription::model) model, const Matrix4& to_world,
                const std::optional<Portal>& portal = {}) {
  Reader& reader = v.reader();
  if (!reader.check_transform(reader.state().ctm[0], v.where())) return;
  LightDescription light;
  light.where = v.where();
  light.model = std::move(model);
  if (reader.state().ctm[0] != reader.state().ctm[1])
    reader.report().warning(v.where(),
                            "lights do not move in pbrt: this one stands where its way begins");
  light.to_world = to_world;
  light.medium = reader.state().outside;
  light.portal = portal;
  reader.scene().lights.push_back(std::move(light));
}

void add(Values& v, decltype(LightDescription::model) model, const Matrix4& to_light,
         const std::optional<Portal>& portal = {}) {
  add_placed(v, std::move(model), v.reader().state().ctm[0] * to_light, portal);
}

#define DUET_LIGHT_SPECS                                         \
  {"scale", Types(kNumber | kColor), "1", "a colour in v3"},     \
      {"nsamples", kInteger, "1", "", 1, inert, Versions::v3}, { \
    "samples", kInteger, "1", "", 1, inert, Versions::v3         \
  }
constexpr Spec kPower{"power", kNumber, "-1",        "total power, instead of what the colour says",
                      1,       done,    Versions::v4};

constexpr Spec kPoint[] = {
    {"I", kColor, "1", "radiant intensity"},
    {"from", kPoint3, "0 0 0", "in v3 added to where the transform puts the origin"},
    kPower,
    DUET_LIGHT_SPECS};

void read_point(Values& v) {
  Spectrum intensity = emitted_color(v, "I") * scale_of(v);
  if (const auto power = positive_of(v, "power")) intensity *= float(*power / (4 * kPi));
  const auto p = v.point("from");
  const Matrix4 from = Matrix4::translate(p[0], p[1], p[2]);
  // v3 moves the light in the world.
  if (v.reader().version() == Version::v3)
    add_placed(v, PointLight{intensity}, from * v.reader().state().ctm[0]);
  else
    add(v, PointLight{intensity}, from);
}

constexpr Spec kSpot[] = {{"I", kColor, "1", "radiant intensity along the axis"},
                          {"from", kPoint3, "0 0 0"},
                          {"to", kPoint3, "0 0 1"},
                          {"coneangle", kNumber, "30", "degrees from the axis"},
                          {"conedeltaangle", kNumber, "5", "over which it fades out"},
                          kPower,
                          DUET_LIGHT_SPECS};

void read_spot(Values& v) {
  if (!differ(v)) return;
  const double cone = std::clamp(v.number("coneangle"), 0.01, 180.0);
  // pbrt takes the cosine of the difference, which may be negative.
  const double full = std::min(std::abs(cone - v.number("conedeltaangle")), cone);
  SpotLight spot;
  spot.cutoff_angle = cone;
  spot.beam_width = full;
  spot.falloff = v.reader().version() == Version::v3 ? SpotFalloff::quartic : SpotFalloff::smooth;
  spot.intensity = emitted_color(v, "I") * scale_of(v);
  if (const auto power = positive_of(v, "power")) {
    const double begin = std::cos(full * kRadians), end = std::cos(cone * kRadians);
    const double solid_angle = 2 * kPi * ((1 - begin) + (begin - end) / 2);
    spot.intensity *= float(*power / solid_angle);
  }
  add(v, spot, aimed(v.point("from"), v.point("to")));
}

constexpr Spec kDistant[] = {{"L", kColor, "1", "irradiance across the direction"},
                             {"from", kPoint3, "0 0 0"},
                             {"to", kPoint3, "0 0 1"},
                             {"illuminance", kNumber, "-1", "", 1, done, Versions::v4},
                             DUET_LIGHT_SPECS};

void read_distant(Values& v) {
  if (!differ(v)) return;
  Spectrum irradiance = emitted_color(v, "L") * scale_of(v);
  if (const auto wanted = positive_of(v, "illuminance")) irradiance *= float(*wanted);
  // The direction alone counts: the transform's stretch does not change the light.
  const auto from = v.point("from"), to = v.point("to");
  const Matrix4& ctm = v.reader().state().ctm[0];
  const Matrix4 placed = ctm * aimed(from, to);
  const double stretch = std::sqrt(placed[0][2] * placed[0][2] + placed[1][2] * placed[1][2] +
                                   placed[2][2] * placed[2][2]);
  if (stretch > 0) irradiance *= float(1 / stretch);
  add(v, DirectionalLight{irradiance}, aimed(from, to));
}

constexpr Spec kInfinite[] = {
    {"L", kColor, "1", "radiance"},
    {"filename", kString, "", "an equal-area image of the sphere", 1, done, Versions::v4},
    {"mapname", kString, "", "an image by latitude and longitude", 1, done, Versions::v3},
    {"illuminance", kNumber, "-1", "of a plane across the light's +z", 1, done, Versions::v4},
    {"portal", kPoint3, "", "corners in the world, through which it is seen", 4, done,
     Versions::v4},
    DUET_LIGHT_SPECS};

/// From the space of latitude-longitude maps, with +y up, to pbrt's, with +z up: columns of both
/// turn about the same axis, from the same half plane on.
Matrix4 z_up() {
  Matrix4 m;
  m.m = {{{0, 0, -1, 0}, {1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 0, 1}}};
  return m;
}

/// The corners of a rectangle in the world; an error if they are not those of one.
std::optional<Portal> read_portal(Values& v) {
  const Parameter* p = v.given("portal");
  if (!p || p->numbers.size() != 12) return std::nullopt;
  std::array<std::array<double, 3>, 4> side;
  Portal portal;
  for (size_t i = 0; i < 4; ++i)
    for (size_t k = 0; k < 3; ++k) portal.corners[i][k] = p->numbers[3 * i + k];
  for (size_t i = 0; i < 4; ++i)
    for (size_t k = 0; k < 3; ++k)
      side[i][k] = portal.corners[(i + 1) % 4][k] - portal.corners[i][k];
  const auto product = [&](size_t i, size_t k) {
    return side[i][0] * side[k][0] + side[i][1] * side[k][1] + side[i][2] * side[k][2];
  };
  constexpr double kTolerance = 1e-3;
  for (size_t i = 0; i < 2; ++i) {
    const double size = std::sqrt(product(i, i) * product(i + 2, i + 2));
    if (!(size > 0) || std::abs(product(i, i + 2) / size + 1) > kTolerance ||
        std::abs(product(i, 1 - i)) > kTolerance * std::sqrt(product(0, 0) * product(1, 1))) {
      v.reader().report().error(p->where, "a portal must be a rectangle, by its corners in order");
      return std::nullopt;
    }
  }
  return portal;
}

void read_infinite(Values& v) {
  const bool v3 = v.reader().version() == Version::v3;
  const char* name = v3 ? "mapname" : "filename";
  const Spectrum scale = scale_of(v);
  if (!v.has(name)) {
    Spectrum radiance = emitted_color(v, "L") * scale;
    if (const auto wanted = positive_of(v, "illuminance")) radiance *= float(*wanted / kPi);
    add(v, ConstantLight{radiance}, {}, read_portal(v));
    return;
  }
  EnvironmentMapLight map;
  map.file = v.file(name);
  if (map.file.empty()) return;
  map.colors = v.reader().image_colors(map.file, ColorMeaning::emission, v.where(name));
  if (!v3 && v.has("L"))
    v.reader().report().error(v.where("L"), "a light has either \"L\" or a file");
  map.gamma = gamma_of_lights(v.reader().version());
  map.tint = v3 ? emitted_color(v, "L") * scale : scale;
  map.layout = v3 ? EnvironmentLayout::row_centers : EnvironmentLayout::equal_area;
  map.illuminance = positive_of(v, "illuminance");
  add(v, map, z_up(), read_portal(v));
}

constexpr Spec kGoniometric[] = {
    {"I", kColor, "1", "multiplies the image"},
    {"filename", kString, "", "an equal-area image of the sphere", 1, done, Versions::v4},
    {"mapname", kString, "", "an image by latitude and longitude", 1, done, Versions::v3},
    kPower,
    DUET_LIGHT_SPECS};

constexpr Spec kProjection[] = {{"I", kColor, "1", "", 1, done, Versions::v3},
                                {"filename", kString, "", "", 1, done, Versions::v4},
                                {"mapname", kString, "", "none: white", 1, done, Versions::v3},
                                {"fov", kNumber, "90", "degrees, along the image's shorter side", 1,
                                 done, Versions::both, "45"},
                                kPower,
                                DUET_LIGHT_SPECS};

void read_goniometric(Values& v) {
  const bool v3 = v.reader().version() == Version::v3;
  const char* const name = v3 ? "mapname" : "filename";
  GoniometricLight light;
  light.scale = emitted_color(v, "I") * scale_of(v);
  light.latitude_longitude = v3;
  if (!v.has(name)) {
    if (v3) return add(v, PointLight{light.scale}, {});
    v.reader().report().error(v.where(), "\"string filename\" is needed");
    return;
  }
  light.file = v.file(name);
  if (light.file.empty()) return;
  BitmapTexture image;
  image.file = light.file;
  scale_to_power(v, light.scale, image,
                 [](const TextureTexels& t) { return 4 * double(kPi) * mean_number(t); });
  // The image has the light's +y in its middle.
  Matrix4 swap;
  swap.m = {{{1, 0, 0, 0}, {0, 0, 1, 0}, {0, 1, 0, 0}, {0, 0, 0, 1}}};
  add(v, light, swap);
}

/// What a projection light throws, as intensity along its axis; nothing after an error.
std::optional<ColorInput> thrown_image(Values& v, double fov) {
  Reader& reader = v.reader();
  const bool v3 = reader.version() == Version::v3;
  const char* name = v3 ? "mapname" : "filename";
  Spectrum scale = scale_of(v);
  if (v3) scale *= emitted_color(v, "I");
  if (!v.has(name)) {
    if (v3) return scale;
    reader.report().error(v.where(), "\"string {}\" is needed", name);
    return std::nullopt;
  }
  BitmapTexture image;
  image.file = v.file(name);
  if (image.file.empty()) return std::nullopt;
  image.colors = reader.image_colors(image.file, ColorMeaning::emission, v.where(name));
  image.gamma = gamma_of_lights(reader.version());
  image.filter = v3 ? TextureFilter::bilinear : TextureFilter::nearest;
  image.wrap_u = image.wrap_v = v3 ? WrapMode::repeat : WrapMode::clamp;
  scale_to_power(v, scale, image,
                 [&](const TextureTexels& pixels) { return projected_power(pixels, fov); });
  const TextureId texture = reader.add_texture(image, v.where());
  return reader.add_texture(ScaledTextureDescription{texture, scale}, v.where());
}

void read_projection(Values& v) {
  ProjectorLight light;
  light.fov = v.number("fov");
  const auto image = thrown_image(v, light.fov);
  if (!image) return;
  light.irradiance = *image;
  light.is_intensity = true;
  light.fov_axis = FovAxis::smaller;
  if (!(light.fov > 0 && light.fov < 180))
    v.reader().report().error(v.where("fov"), "a field of view lies between 0 and 180 degrees");
  // Its +x is at the image's right, and its +y at the image's top, in v3 at its bottom.
  add(v, light, Matrix4::scale(-1, v.reader().version() == Version::v3 ? -1 : 1, 1));
}

constexpr Record<void (*)(Values&)> kLights[] = {
    {"point", Versions::both, done, "", kPoint, read_point},
    {"spot", Versions::both, done, "the edge is t⁴ in v3, t²(3 − 2t) in v4", kSpot, read_spot},
    {"distant", Versions::both, done, "", kDistant, read_distant},
    {"infinite", Versions::both, done, "", kInfinite, read_infinite},
    {"exinfinite", Versions::v3, done, "", kInfinite, read_infinite},
    {"goniometric", Versions::both, done, "", kGoniometric, read_goniometric},
    {"projection", Versions::both, done, "", kProjection, read_projection},
};

#undef DUET_LIGHT_SPECS

}  // namespace

void read_light(Reader& reader, const Plugin& plugin) {
  if (const auto* record = find_record<void (*)(Values&)>(reader, plugin, kLights)) {
    Values values(reader, plugin, record->parameters);
    record->read(values);
  }
}

void list_lights(std::vector<Row>& rows) {
  list(rows, "LightSource", kLights);
  list_area_lights(rows);
}

}  // namespace duet::pbrt
