// Textures.
#include <algorithm>
#include <array>

#include "pbrt/records.h"
#include "pbrt/values.h"
#include "pbrt/vocabulary.h"
#include "values/text.h"

namespace duet::pbrt {

namespace {

using enum Status;

/// A texture while it is read: of colours, or of numbers.
struct Request {
  bool is_color;
  ColorMeaning meaning = ColorMeaning::reflectance;
};
/// Only the one that was asked for counts.
struct Made {
  ColorInput color = Spectrum(0.0f);
  FloatInput number = 0.0;
};

#define DUET_MAPPING_SPECS                                                                      \
  {"mapping", kString, "uv", "uv, spherical, cylindrical or planar"}, {"uscale", kNumber, "1"}, \
      {"vscale", kNumber, "1"}, {"udelta", kNumber, "0"}, {"vdelta", kNumber, "0"},             \
      {"v1", kVector3, "1 0 0"}, {                                                              \
    "v2", kVector3, "0 1 0"                                                                     \
  }
constexpr Types kEither = kColorTexture | kNumberTexture;

/// From the world to the space of the texture: the transform that held at the directive.
Matrix4 from_world(Values& v) {
  const Matrix4& ctm = v.reader().state().ctm[0];
  if (!v.reader().check_transform(ctm, v.where())) return {};
  return *ctm.inverse();
}

/// From the surface's coordinates to the texture's (s, t).
UvTransform mapping(Values& v) {
  UvTransform m;
  const std::string kind = v.string("mapping");
  if (kind == "uv")
    m.m = {
        {{v.number("uscale"), 0, v.number("udelta")}, {0, v.number("vscale"), v.number("vdelta")}}};
  else if (kind != "spherical" && kind != "cylindrical" && kind != "planar")
    v.reader().report().error(v.where("mapping"), "there is no mapping {}", in_quotes(kind));
  return m;
}

/// The texture looked up where its mapping says, unless that is by the surface's coordinates.
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

/// Both forms of a texture that is not constant.
void set(Made& made, TextureId id) {
  made.color = id;
  made.number = id;
}

/// A number as a colour; textures are the same.
ColorInput as_color(const FloatInput& input) {
  if (const double* constant = std::get_if<double>(&input)) return Spectrum(float(*constant));
  return std::get<TextureId>(input);
}

/// What was asked for, as a colour.
ColorInput input_of(const Request& request, const Made& made) {
  return request.is_color ? made.color : as_color(made.number);
}

/// A value of one of the texture's own parameters.
void read_input(Values& v, const Request& request, std::string_view name, Made& made) {
  const Parameter* p = v.given(name);
  if (request.is_color) {
    if (p && p->type == Type::number)
      made.color = Spectrum(float(p->numbers.front()));
    else
      made.color = v.color_input(name, request.meaning);
  } else {
    made.number = v.float_input(name);
  }
}

constexpr Spec kConstant[] = {{"value", kEither, "1"}};

void read_constant(Values& v, const Request& request, Made& made) {
  read_input(v, request, "value", made);
}

constexpr Spec kImage[] = {
    {"filename", kString},
    {"scale", kNumber, "1"},
    {"invert", kBoolean, "false", "", 1, done, Versions::v4},
    {"encoding", kString, "", "sRGB, linear or gamma and a number", 1, done, Versions::v4},
    {"gamma", kBoolean, "", "whether it is sRGB", 1, done, Versions::v3},
    {"wrap", kString, "repeat", "repeat, black or clamp"},
    {"filter", kString, "bilinear", "point, or anything else as bilinear", 1, done, Versions::v4},
    {"maxanisotropy", kNumber, "8", "", 1, inert},
    {"trilinear", kBoolean, "false", "", 1, inert, Versions::v3},
    DUET_MAPPING_SPECS};

bool is_png(const std::string& file) {
  return file.size() > 4 && to_lower(file.substr(file.size() - 4)) == ".png";
}

void read_encoding(Values& v, BitmapTexture& image) {
  if (v.reader().version() == Version::v3) {
    if (v.has("gamma")) image.gamma = v.boolean("gamma") ? -1 : 1;
    return;
  }
  const std::string encoding = v.string("encoding");
  if (encoding.empty() || !is_png(image.file)) return;  // pbrt reads others by their format
  double gamma = 0;
  if (encoding.starts_with("gamma")) gamma = parse_number(encoding.substr(5)).value_or(0);
  if (encoding == "linear")
    image.gamma = 1;
  else if (encoding == "sRGB")
    image.gamma = -1;
  else if (gamma > 0)
    image.gamma = gamma;
  else
    v.reader().report().error(v.where("encoding"),
                              "an encoding is sRGB, linear or gamma and a number, not {}",
                              in_quotes(encoding));
}

void read_image(Values& v, const Request& request, Made& made) {
  Reader& reader = v.reader();
  if (!v.has("filename")) {
    reader.report().error(v.where(), "\"string filename\" is needed");
    return;
  }
  BitmapTexture image;
  image.file = v.file("filename");
  if (image.file.empty()) return;
  read_encoding(v, image);
  if (v.reader().version() == Version::v4 && v.string("filter") == "point")
    image.filter = TextureFilter::nearest;
  const std::string wrap = v.string("wrap");
  if (wrap == "clamp")
    image.wrap_u = image.wrap_v = WrapMode::clamp;
  else if (wrap == "black")
    image.wrap_u = image.wrap_v = WrapMode::zero;
  else if (wrap != "repeat")
    reader.report().error(v.where("wrap"), "the wrap mode {} is not supported", in_quotes(wrap));
  image.to_uv = mapping(v);
  // A number of an image in colours: in v3 the luminance, as textures have it by themselves.
  if (!request.is_color && reader.version() == Version::v4) image.channel = TextureChannel::number;
  if (request.is_color && reader.film_color_space != 0)
    reader.approximate(v.where(), "images in the film's colour space: their own is left out");
  // Their first row is at t = 1.
  for (double& x : image.to_uv.m[1]) x = -x;
  image.to_uv.m[1][2] += 1;
  TextureId id = reader.add_texture(image, v.where());
  id = mapped(v, id);
  if (const double scale = v.number("scale"); scale != 1)
    id = reader.add_texture(ScaledTextureDescription{id, Spectrum(float(scale))}, v.where());
  if (reader.version() == Version::v4 && v.boolean("invert"))
    id = reader.add_texture(FunctionDescription{id, TextureFunction::inverse}, v.where());
  set(made, id);
}

constexpr Spec kChecks[] = {{"tex1", kEither, "1"},
                            {"tex2", kEither, "0"},
                            {"dimension", kInteger, "2"},
                            {"aamode", kString, "closedform", "", 1, inert, Versions::v3},
                            DUET_MAPPING_SPECS};

void read_checkerboard(Values& v, const Request& request, Made& made) {
  Reader& reader = v.reader();
  Made first, second;
  read_input(v, request, "tex1", first);
  read_input(v, request, "tex2", second);
  const ColorInput a = input_of(request, first), b = input_of(request, second);
  const int dimension = v.integer("dimension");
  if (dimension == 3) {
    set(made, reader.add_texture(SolidCheckerboardDescription{a, b, from_world(v)}, v.where()));
    return;
  }
  if (dimension != 2)
    reader.report().error(v.where("dimension"), "a checkerboard has 2 or 3 dimensions, not {}",
                          dimension);
  CheckerboardTexture board;
  board.to_uv = mapping(v);
  const bool by_uv = v.string("mapping") == "uv";
  // Textures in it keep their own mapping: then the board says only which of the two it is.
  board.color0 = by_uv ? a : ColorInput(Spectrum(0.0f));
  board.color1 = by_uv ? b : ColorInput(Spectrum(1.0f));
  // Mitsuba's squares are half as wide.
  for (auto& row : board.to_uv.m)
    for (double& x : row) x *= 0.5;
  TextureId id = reader.add_texture(board, v.where());
  if (!by_uv) id = reader.add_texture(MixDescription{a, b, mapped(v, id)}, v.where());
  set(made, id);
}

constexpr Spec kScale[] = {{"tex", kEither, "1", "", 1, done, Versions::v4},
                           {"scale", kNumberTexture, "1", "", 1, done, Versions::v4},
                           {"tex1", kEither, "1", "", 1, done, Versions::v3},
                           {"tex2", kEither, "1", "", 1, done, Versions::v3}};

void read_scale(Values& v, const Request& request, Made& made) {
  Reader& reader = v.reader();
  const bool v3 = reader.version() == Version::v3;
  Made a, b;
  read_input(v, request, v3 ? "tex1" : "tex", a);
  if (v3) {
    read_input(v, request, "tex2", b);
  } else {
    b.number = v.float_input("scale");
    if (const double* n = std::get_if<double>(&b.number))
      b.color = Spectrum(float(*n));
    else
      b.color = std::get<TextureId>(b.number);
  }
  const auto product = [&](auto& x, auto& y, auto& result) {
    using Constant = std::variant_alternative_t<0, std::decay_t<decltype(x)>>;
    const Constant *p = std::get_if<Constant>(&x), *q = std::get_if<Constant>(&y);
    if (p && q) {
      result = *p * *q;
    } else if (p || q) {
      const Constant factor = p ? *p : *q;
      const TextureId inner = std::get<TextureId>(p ? y : x);
      Spectrum scale;
      if constexpr (std::is_same_v<Constant, double>)
        scale = Spectrum(float(factor));
      else
        scale = factor;
      result = reader.add_texture(ScaledTextureDescription{inner, scale}, v.where());
    } else {
      result = reader.add_texture(
          ProductDescription{std::get<TextureId>(x), std::get<TextureId>(y)}, v.where());
    }
  };
  if (request.is_color)
    product(a.color, b.color, made.color);
  else
    product(a.number, b.number, made.number);
}

constexpr Spec kMixTexture[] = {{"tex1", kEither, "0", "", 1, done, Versions::both, "0"},
                                {"tex2", kEither, "1"},
                                {"amount", kNumberTexture, "0.5"}};

void read_mix_texture(Values& v, const Request& request, Made& made) {
  Made a, b;
  read_input(v, request, "tex1", a);
  read_input(v, request, "tex2", b);
  const FloatInput amount = v.float_input("amount");
  const double* t = std::get_if<double>(&amount);
  const Spectrum *ca = std::get_if<Spectrum>(&a.color), *cb = std::get_if<Spectrum>(&b.color);
  const double *na = std::get_if<double>(&a.number), *nb = std::get_if<double>(&b.number);
  if (t && request.is_color && ca && cb)
    made.color = lerp(*ca, *cb, float(*t));
  else if (t && !request.is_color && na && nb)
    made.number = *na * (1 - *t) + *nb * *t;
  else
    set(made, v.reader().add_texture(
                  MixDescription{input_of(request, a), input_of(request, b), amount}, v.where()));
}

constexpr Spec kDirectionMix[] = {
    {"tex1", kEither, "0"}, {"tex2", kEither, "1"}, {"dir", kVector3, "0 1 0"}};

void read_direction_mix(Values& v, const Request& request, Made& made) {
  Made a, b;
  read_input(v, request, "tex1", a);
  read_input(v, request, "tex2", b);
  const auto d = v.point("dir");
  const Matrix4& m = v.reader().state().ctm[0];
  std::array<double, 3> w{};
  for (int i = 0; i < 3; ++i)
    for (size_t j = 0; j < 3; ++j) w[size_t(i)] += m[i][j] * d[j];
  set(made, v.reader().add_texture(DirectionMixDescription{input_of(request, a),
                                                           input_of(request, b), w[0], w[1], w[2]},
                                   v.where()));
}

constexpr Spec kBilerp[] = {{"v00", kEither, "0"},
                            {"v01", kEither, "1"},
                            {"v10", kEither, "0"},
                            {"v11", kEither, "1"},
                            DUET_MAPPING_SPECS};

void read_bilerp(Values& v, const Request& request, Made& made) {
  BilerpDescription b;
  const auto corner = [&](const char* name) {
    Made value;
    read_input(v, request, name, value);
    const ColorInput input = input_of(request, value);
    if (const Spectrum* constant = std::get_if<Spectrum>(&input)) return *constant;
    v.reader().report().error(v.where(name), "a corner of bilerp is no texture");
    return Spectrum(0.0f);
  };
  b.v00 = corner("v00"), b.v01 = corner("v01"), b.v10 = corner("v10"), b.v11 = corner("v11");
  b.to_uv = mapping(v);
  set(made, mapped(v, v.reader().add_texture(b, v.where())));
}

constexpr Spec kDots[] = {{"inside", kEither, "1", "around the dots, as pbrt has it"},
                          {"outside", kEither, "0", "in the dots"},
                          DUET_MAPPING_SPECS};

void read_dots(Values& v, const Request& request, Made& made) {
  Reader& reader = v.reader();
  Made inside, outside;
  read_input(v, request, "inside", inside);
  read_input(v, request, "outside", outside);
  // pbrt's images have "inside" around the dots and "outside" in them.
  const ColorInput a = input_of(request, outside), b = input_of(request, inside);
  DotsDescription dots;
  dots.to_uv = mapping(v);
  if (v.string("mapping") == "uv") {
    dots.inside = a, dots.outside = b;
    set(made, reader.add_texture(dots, v.where()));
    return;
  }
  // Textures in it keep their own mapping.
  const TextureId where = mapped(v, reader.add_texture(dots, v.where()));
  set(made, reader.add_texture(MixDescription{b, a, where}, v.where()));
}

constexpr Spec kNoise[] = {{"octaves", kInteger, "8"}, {"roughness", kNumber, "0.5"}};
constexpr Spec kMarble[] = {{"octaves", kInteger, "8"},
                            {"roughness", kNumber, "0.5"},
                            {"scale", kNumber, "1"},
                            {"variation", kNumber, "0.2"}};

void add_noise(Values& v, NoiseKind kind, Made& made) {
  NoiseTextureDescription n;
  n.kind = kind;
  n.from_world = from_world(v);
  if (kind != NoiseKind::windy) {
    n.octaves = std::clamp(v.integer("octaves"), 1, 32);
    n.roughness = v.number("roughness");
  }
  if (kind == NoiseKind::marble) n.scale = v.number("scale"), n.variation = v.number("variation");
  set(made, v.reader().add_texture(n, v.where()));
}

template <NoiseKind kind>
void read_noise(Values& v, const Request&, Made& made) {
  add_noise(v, kind, made);
}

using ReadTexture = void (*)(Values&, const Request&, Made&);
constexpr Record<ReadTexture> kTextures[] = {
    {"constant", Versions::both, done, "", kConstant, read_constant},
    {"imagemap", Versions::both, done, "never blurred by its distance", kImage, read_image},
    {"checkerboard", Versions::both, done, "never blurred by its distance", kChecks,
     read_checkerboard},
    {"scale", Versions::both, done, "", kScale, read_scale},
    {"mix", Versions::both, done, "", kMixTexture, read_mix_texture},
    {"directionmix", Versions::v4, done, "", kDirectionMix, read_direction_mix},
    {"bilerp", Versions::both, done, "", kBilerp, read_bilerp},
    {"dots", Versions::both, done, "", kDots, read_dots},
    {"fbm", Versions::both, done, "never blurred by its distance", kNoise,
     read_noise<NoiseKind::fbm>},
    {"wrinkled", Versions::both, done, "never blurred by its distance", kNoise,
     read_noise<NoiseKind::wrinkled>},
    {"windy",
     Versions::both,
     done,
     "never blurred by its distance",
     {},
     read_noise<NoiseKind::windy>},
    {"marble", Versions::both, done, "never blurred by its distance", kMarble,
     read_noise<NoiseKind::marble>},
    {"uv", Versions::v3, refused, "texture coordinates as colours", {}, nullptr},
    {"ptex",
     Versions::both,
     refused,
     "textures per face: Debian has no library for them",
     {},
     nullptr},
};

#undef DUET_MAPPING_SPECS

}  // namespace

void read_texture(Reader& reader, const Plugin& plugin, const std::string& name,
                  const std::string& kind) {
  Request request{kind == "spectrum" || kind == "color"};
  if (!request.is_color && kind != "float") {
    reader.report().error(plugin.where, "a texture is of \"spectrum\" or \"float\", not {}",
                          in_quotes(kind));
    return;
  }
  const auto* record = find_record<ReadTexture>(reader, plugin, kTextures);
  Made made;
  if (request.is_color)
    made.color = Spectrum(0.5f);
  else
    made.number = 0.5;
  if (record) {
    Values values(reader, plugin, record->parameters);
    record->read(values, request, made);
  }
  // After an error it has a value, too, so that its users are not reported.
  if (request.is_color)
    reader.define_texture(name, made.color, plugin.where);
  else
    reader.define_texture(name, made.number, plugin.where);
}

void list_textures(std::vector<Row>& rows) {
  list(rows, "Texture", kTextures);
}

}  // namespace duet::pbrt
