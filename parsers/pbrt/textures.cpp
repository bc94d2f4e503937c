// Textures: images, constants and what is made of others.
#include <algorithm>

#include "pbrt/texture_readers.h"
#include "pbrt/vocabulary.h"
#include "values/text.h"

namespace duet::pbrt {

namespace {

/// A number as a colour; textures are the same.
ColorInput as_color(const FloatInput& input) {
  if (const double* constant = std::get_if<double>(&input)) return Spectrum(float(*constant));
  return std::get<TextureId>(input);
}

}  // namespace

void set(Made& made, TextureId id) {
  made.color = id;
  made.number = id;
}

void read_input(Values& v, const Request& request, std::string_view name, Made& made) {
  v.drop_others_in_v3(name, request.is_color ? kColorTexture : kNumberTexture);
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

ColorInput color_of(Values& v, const Request& request, std::string_view name) {
  Made made;
  read_input(v, request, name, made);
  return request.is_color ? made.color : as_color(made.number);
}

namespace {

using enum Status;

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
    {"wrap", kString, "repeat", "repeat, black or clamp; octahedralsphere as clamp"},
    {"filter", kString, "bilinear", "point; bilinear, trilinear and ewa as bilinear", 1, done,
     Versions::v4},
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

TextureFilter read_filter(Values& v) {
  const std::vector<std::string> known{"point", "bilinear", "trilinear", "ewa", "EWA"};
  const std::string filter = v.string("filter");
  if (std::find(known.begin(), known.end(), filter) == known.end())
    v.reader().report().warning(v.where("filter"),
                                "there is no filter {}{}; the image is interpolated, as in pbrt",
                                in_quotes(filter), did_you_mean(filter, known));
  return filter == "point" ? TextureFilter::nearest : TextureFilter::bilinear;
}

WrapMode read_wrap(Values& v) {
  const std::string wrap = v.string("wrap");
  if (wrap == "clamp") return WrapMode::clamp;
  if (wrap == "black") return WrapMode::zero;
  if (wrap == "octahedralsphere" && v.reader().version() == Version::v4) {
    v.reader().approximate(v.where("wrap"),
                           "an image of a sphere as octahedron does not go on behind its edges");
    return WrapMode::clamp;
  }
  if (wrap != "repeat" && v.reader().version() == Version::v3)
    v.reader().report().warning(v.where("wrap"),
                                "there is no wrap mode {}; the image repeats, as in pbrt-v3",
                                in_quotes(wrap));
  else if (wrap != "repeat")
    v.reader().report().error(v.where("wrap"), "the wrap mode {} is not supported",
                              in_quotes(wrap));
  return WrapMode::repeat;
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
  if (reader.version() == Version::v4) image.filter = read_filter(v);
  image.wrap_u = image.wrap_v = read_wrap(v);
  image.to_uv = mapping(v);
  // A number of an image in colours: in v3 the luminance, as textures have it by themselves.
  if (!request.is_color && reader.version() == Version::v4) image.channel = TextureChannel::number;
  if (request.is_color)
    image.colors = reader.image_colors(image.file, ColorMeaning::reflectance, v.where());
  // Their first row is at t = 1.
  for (double& x : image.to_uv.m[1]) x = -x;
  image.to_uv.m[1][2] += 1;
  TextureId id = reader.add_texture(image, v.where());
  id = mapped(v, id);
  if (const double scale = v.number("scale"); scale != 1)
    id = reader.add_texture(ScaledTextureDescription{id, Spectrum(float(scale))}, v.where());
  const auto invert = [&] {
    id = reader.add_texture(FunctionDescription{id, TextureFunction::inverse}, v.where());
  };
  if (reader.version() == Version::v4 && v.boolean("invert")) invert();
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
    b.color = as_color(b.number);
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
  else if (request.is_color)
    set(made, v.reader().add_texture(MixDescription{a.color, b.color, amount}, v.where()));
  else
    set(made, v.reader().add_texture(MixDescription{as_color(a.number), as_color(b.number), amount},
                                     v.where()));
}

constexpr Spec kDirectionMix[] = {
    {"tex1", kEither, "0"}, {"tex2", kEither, "1"}, {"dir", kVector3, "0 1 0"}};

void read_direction_mix(Values& v, const Request& request, Made& made) {
  const ColorInput a = color_of(v, request, "tex1"), b = color_of(v, request, "tex2");
  const auto d = v.point("dir");
  const Matrix4& m = v.reader().state().ctm[0];
  std::array<double, 3> w{};
  for (int i = 0; i < 3; ++i)
    for (size_t j = 0; j < 3; ++j) w[size_t(i)] += m[i][j] * d[j];
  set(made, v.reader().add_texture(DirectionMixDescription{a, b, w[0], w[1], w[2]}, v.where()));
}

constexpr Record<ReadTexture> kTextures[] = {
    {"constant", Versions::both, done, "", kConstant, read_constant},
    {"imagemap", Versions::both, done, "never blurred by its distance", kImage, read_image},
    {"scale", Versions::both, done, "", kScale, read_scale},
    {"mix", Versions::both, done, "", kMixTexture, read_mix_texture},
    {"directionmix", Versions::v4, done, "", kDirectionMix, read_direction_mix},
    {"ptex",
     Versions::both,
     refused,
     "textures per face: Debian has no library for them",
     {},
     nullptr},
};

const std::vector<Record<ReadTexture>>& textures() {
  static const std::vector<Record<ReadTexture>> all = [] {
    std::vector<Record<ReadTexture>> list(std::begin(kTextures), std::end(kTextures));
    const auto patterns = pattern_textures();
    list.insert(list.end(), patterns.begin(), patterns.end());
    return list;
  }();
  return all;
}

/// v4 has some patterns of one kind only.
void check_kind(Reader& reader, const Plugin& plugin, bool is_color) {
  const bool of_numbers =
      plugin.name == "fbm" || plugin.name == "wrinkled" || plugin.name == "windy";
  if (is_color ? of_numbers : plugin.name == "marble")
    reader.report().error(plugin.where, "Texture \"{}\" makes {} in pbrt-v4", plugin.name,
                          is_color ? "numbers, not colours," : "colours, not numbers,");
}

}  // namespace

void read_texture(Reader& reader, const Plugin& plugin, const std::string& name,
                  const std::string& kind) {
  const bool is_v4 = reader.version() == Version::v4;
  Request request{kind == "spectrum" || (kind == "color" && !is_v4)};
  if (!request.is_color && kind != "float") {
    reader.report().error(plugin.where, "a texture is of \"spectrum\" or \"float\", not {}",
                          in_quotes(kind));
    return;
  }
  if (is_v4) check_kind(reader, plugin, request.is_color);
  const auto* record = find_record<ReadTexture>(reader, plugin, textures());
  Made made;
  if (request.is_color)
    made.color = Spectrum(0.5f);
  else
    made.number = 0.5;
  if (record) {
    Values values(reader, plugin, record->parameters);
    record->read(values, request, made);
  }
  const bool is_image = plugin.name == "imagemap";
  // After an error it has a value, too, so that its users are not reported.
  if (request.is_color)
    reader.define_texture(name, made.color, is_image, plugin.where);
  else
    reader.define_texture(name, made.number, is_image, plugin.where);
}

void list_textures(std::vector<Row>& rows) {
  list(rows, "Texture", std::span<const Record<ReadTexture>>(textures()));
}

}  // namespace duet::pbrt
