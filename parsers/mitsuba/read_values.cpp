// Parameters that may be numbers, colours, names or textures.
#include <cmath>

#include "files/file_access.h"
#include "mitsuba/scene_reader.h"
#include "values/ior.h"
#include "values/text.h"

namespace duet {

namespace {

ColorMeaning meaning_of(ParameterType type) {
  switch (type) {
    case ParameterType::emission:
      return ColorMeaning::emission;
    case ParameterType::unbounded:
    case ParameterType::coefficient:
    case ParameterType::number_or_volume:
      return ColorMeaning::unbounded;
    default:
      return ColorMeaning::reflectance;
  }
}

double preset_number(const Properties& p, std::string_view name) {
  return parse_number(p.preset(name)).value_or(0);
}

}  // namespace

Spectrum SceneReader::checked(Properties& p, std::string_view name, const Triple& rgb,
                              ColorMeaning meaning, bool limited) {
  const Spectrum s = to_spectrum(rgb);
  const double least = std::min({rgb[0], rgb[1], rgb[2]}),
               most = std::max({rgb[0], rgb[1], rgb[2]});
  if (least < 0) {
    p.error(name, "the colour {} {} {} has a negative component", s.r, s.g, s.b);
    return Spectrum(0.0f);
  }
  if (meaning != ColorMeaning::reflectance || most <= 1) return s;
  if (!p.is_0x()) {
    if (limited) p.error(name, "the reflectance {} {} {} is greater than 1", s.r, s.g, s.b);
    return s;
  }
  if (p.node().kind != PluginKind::bsdf || !p.boolean("ensure_energy_conservation")) return s;
  // As Mitsuba 0.6 does.
  const float scale = 0.99f / float(most);
  report_.warning(p.where(name), "the reflectance is greater than 1 and scaled by {:.4g}", scale);
  return s * scale;
}

std::optional<ColorInput> SceneReader::color_of(Properties& p, std::string_view name,
                                                const Property& property, ColorMeaning meaning) {
  const PropertyValue& v = property.value;
  const auto grey = [&](double value) {
    return checked(p, name, {value, value, value}, meaning, false);
  };
  if (const double* number = std::get_if<double>(&v)) return grey(*number);
  if (const int64_t* number = std::get_if<int64_t>(&v)) return grey(double(*number));
  if (const RgbColor* rgb = std::get_if<RgbColor>(&v))
    return checked(p, name, rgb->value, meaning, true);
  if (const ScalarSpectrum* spectrum = std::get_if<ScalarSpectrum>(&v)) {
    const Spectrum value = grey(spectrum->value);
    // In 0.x it stands for white light of that power, in 3.x for light of equal power everywhere.
    return meaning == ColorMeaning::emission && !p.is_0x() ? equal_energy_rgb(double(value.r))
                                                           : value;
  }
  if (const auto* samples = std::get_if<std::vector<SpectrumSample>>(&v))
    return p.is_0x() ? spectrum_to_rgb(*samples, meaning)
                     : stepped_spectrum_to_rgb(*samples, meaning);
  if (const Blackbody* body = std::get_if<Blackbody>(&v))
    return spectrum_to_rgb(blackbody_spectrum(body->kelvin, body->scale), meaning);
  if (const Node* const* node = std::get_if<const Node*>(&v)) {
    if (!(*node)->plugin) return std::nullopt;
    if ((*node)->kind == PluginKind::texture) return color(**node, meaning);
  }
  p.wrong_type(name, property);
  return std::nullopt;
}

std::optional<ColorInput> SceneReader::color(const Node& node, ColorMeaning meaning) {
  if (node.plugin && std::holds_alternative<ReadInto<MeantColor>>(node.plugin->reader)) {
    MeantColor color{meaning, {}};
    read_into(node, color);
    return color.value;
  }
  if (const auto id = texture(node)) return *id;
  return std::nullopt;
}

ColorInput SceneReader::color(Properties& p, std::string_view name) {
  const Spectrum preset(float(preset_number(p, name)));
  const Property* property = p.find(name);
  if (!property) return preset;
  return color_of(p, name, *property, meaning_of(p.parameter(name).type)).value_or(preset);
}

ColorVolume SceneReader::color_volume(Properties& p, std::string_view name) {
  const Spectrum preset(float(preset_number(p, name)));
  const Property* property = p.find(name);
  if (!property) return preset;
  const ColorMeaning meaning = meaning_of(p.parameter(name).type);
  if (const Node* const* node = std::get_if<const Node*>(&property->value);
      node && (*node)->kind == PluginKind::volume)
    return volume(**node, meaning).value_or(preset);
  const auto color = color_of(p, name, *property, meaning);
  if (!color) return preset;
  if (const Spectrum* constant = std::get_if<Spectrum>(&*color)) return *constant;
  const auto value = value_for_volume(p, name, std::get<TextureId>(*color));
  return value ? value->color : preset;
}

std::optional<TextureValue> SceneReader::value_for_volume(Properties& p, std::string_view name,
                                                          TextureId texture) {
  Diagnostics diagnostics;
  const auto value = texture_at_origin(description_, texture, diagnostics);
  for (const Diagnostic& d : diagnostics.all()) report_.error(d.where, "{}", d.message);
  if (value)
    report_.warning(p.where(name),
                    "{} asks for a volume as \"{}\": the value of the texture at the texture "
                    "coordinates (0, 0) holds everywhere",
                    describe(p.node()), name);
  return value;
}

FloatVolume SceneReader::float_volume(Properties& p, std::string_view name) {
  const ColorVolume value = color_volume(p, name);
  if (const VolumeId* id = std::get_if<VolumeId>(&value)) return *id;
  return double(std::get<Spectrum>(value).luminance());
}

Spectrum SceneReader::constant_color(Properties& p, std::string_view name) {
  const ColorInput input = color(p, name);
  if (const Spectrum* constant = std::get_if<Spectrum>(&input)) return *constant;
  p.error(name, "the parameter \"{}\" of {} cannot be a texture", name, describe(p.node()));
  return Spectrum(0.0f);
}

FloatInput SceneReader::number_or_texture(Properties& p, std::string_view name) {
  const double preset = preset_number(p, name);
  const Property* property = p.find(name);
  if (!property) return preset;
  const PropertyValue& v = property->value;
  if (std::holds_alternative<double>(v) || std::holds_alternative<int64_t>(v))
    return p.optional_number(name).value_or(preset);
  if (const ScalarSpectrum* spectrum = std::get_if<ScalarSpectrum>(&v)) return spectrum->value;
  if (const RgbColor* rgb = std::get_if<RgbColor>(&v)) {
    const auto [r, g, b] = rgb->value;
    if (r == g && g == b) return r;
    // Mitsuba 3 takes the mean; 0.6, where such numbers can be colours, keeps the colour.
    if (!p.is_0x()) return (r + g + b) / 3;
    approximate_loudly(
        property->where,
        fmt::format("the colour of \"{}\" is replaced by its luminance", property->written));
    return 0.212671 * r + 0.715160 * g + 0.072169 * b;
  }
  const auto input = color_of(p, name, *property, ColorMeaning::reflectance);
  if (!input) return preset;
  if (const TextureId* id = std::get_if<TextureId>(&*input)) return *id;
  return double(std::get<Spectrum>(*input).mean());
}

std::optional<TextureId> SceneReader::texture(Properties& p, std::string_view name) {
  const Node* const* node = p.value<const Node*>(name);
  return node ? texture(**node) : std::nullopt;
}

double SceneReader::index_of_refraction(Properties& p, std::string_view name) {
  const double preset = find_dielectric(p.preset(name)).value_or(1);
  const Property* property = p.find(name);
  if (!property) return preset;
  if (const std::string* material = std::get_if<std::string>(&property->value)) {
    if (const auto value = find_dielectric(*material)) return *value;
    p.error(name, "no index of refraction is known for {}{}", in_quotes(*material),
            did_you_mean(to_lower(*material), dielectric_names()));
    return preset;
  }
  if (std::holds_alternative<double>(property->value) ||
      std::holds_alternative<int64_t>(property->value)) {
    const auto value = p.optional_number(name);
    if (value && *value > 0) return *value;
    if (value) p.error(name, "an index of refraction must be positive, not {}", *value);
  } else {
    p.wrong_type(name, *property);
  }
  return preset;
}

std::string SceneReader::file(Properties& p, std::string_view name) {
  const std::string* text = p.value<std::string>(name);
  if (!text) return "";
  if (const auto path = find_file(*text, *p.node().folders, access_)) return absolute_path(*path);
  p.error(name, "{}", not_found(*text, *p.node().folders));
  return "";
}

}  // namespace duet
