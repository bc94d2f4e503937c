#include "xml/value_elements.h"

#include <algorithm>

#include "values/ior.h"
#include "values/spectrum_text.h"
#include "values/text.h"

namespace duet {

namespace {

/// Three numbers from value="x, y, z", from one number for all, or from x= y= z=.
PropertyValue read_triple(const ElementContext& c, const Attributes& a) {
  if (a.has("value")) {
    if (!a.check({"!name", "value"})) return Broken{};
    const auto numbers = parse_numbers(a["value"]);
    if (!numbers || (numbers->size() != 3 && numbers->size() != 1)) {
      c.report.error(a.where("value"), "{} is not a list of three numbers", in_quotes(a["value"]));
      return Broken{};
    }
    const std::vector<double>& n = *numbers;
    return n.size() == 3 ? Triple{n[0], n[1], n[2]} : Triple{n[0], n[0], n[0]};
  }
  if (!a.check({"!name", "!x", "!y", "!z"})) return Broken{};
  Triple triple{};
  bool good = true;
  for (int i = 0; i < 3; ++i) {
    const std::string_view name = i == 0 ? "x" : i == 1 ? "y" : "z";
    if (const auto number = parse_number(a[name])) {
      triple[i] = *number;
    } else {
      c.report.error(a.where(name), "{} is not a number", in_quotes(a[name]));
      good = false;
    }
  }
  return good ? PropertyValue(triple) : PropertyValue(Broken{});
}

PropertyValue read_rgb(const ElementContext& c, const Attributes& a, bool srgb) {
  if (!a.check({"!name", "!value", "intent"})) return Broken{};
  const std::string& text = a["value"];
  Triple color{};
  if (trim(text).starts_with('#')) {
    const auto hex = parse_hex_color(text);
    if (!hex) {
      c.report.error(a.where("value"), "{} is not a colour of the form #rrggbb", in_quotes(text));
      return Broken{};
    }
    if (!srgb && !c.version.is_0x()) {
      c.report.error(
          a.where("value"),
          "<rgb> takes no hexadecimal numbers since version 2; <srgb> does, and decodes them");
      return Broken{};
    }
    color = *hex;
  } else {
    const auto numbers = parse_numbers(text);
    if (!numbers || (numbers->size() != 1 && numbers->size() != 3)) {
      c.report.error(a.where("value"), "{} is not a colour of one or three numbers",
                     in_quotes(text));
      return Broken{};
    }
    for (int i = 0; i < 3; ++i) color[i] = (*numbers)[numbers->size() == 3 ? size_t(i) : 0];
  }
  if (srgb)
    for (double& v : color) v = double(srgb_to_linear(float(v)));
  return RgbColor{color};
}

/// Checks what all tabulated spectra must fulfil.
PropertyValue checked_spectrum(const ElementContext& c, const SourceLocation& where,
                               std::vector<SpectrumSample> samples) {
  if (samples.size() < 2) {
    c.report.error(where, "a tabulated spectrum needs at least two entries");
    return Broken{};
  }
  const size_t i = first_not_increasing(samples);
  if (i == 0) return samples;
  c.report.error(where, "the wavelengths of a spectrum must increase, but {} follows {}",
                 samples[i].wavelength, samples[i - 1].wavelength);
  return Broken{};
}

PropertyValue read_spectrum_file(const ElementContext& c, const Attributes& a) {
  const SourceLocation& where = a.where("filename");
  const auto path = find_file(a["filename"], c.folders, c.access);
  if (!path)
    if (const Spectrum* s = index_of_file(a["name"], a["filename"]))
      return RgbColor{{double(s->r), double(s->g), double(s->b)}};
  const auto text = path ? c.access.read(*path) : std::nullopt;
  if (!text) {
    c.report.error(where, "{}",
                   path ? "cannot read " + in_quotes(*path) : not_found(a["filename"], c.folders));
    return Broken{};
  }
  try {
    return checked_spectrum(c, where, parse_spectrum_lines(*text, *path));
  } catch (const ReadError& error) {
    c.report.error(where, "{}", error.what());
    return Broken{};
  }
}

PropertyValue read_spectrum(const ElementContext& c, const Attributes& a) {
  if (!a.check({"!name", "value", "filename", "intent"})) return Broken{};
  // To Mitsuba 3 an empty one is as good as none.
  const auto given = [&](std::string_view name) {
    return a.has(name) && (c.version.is_0x() || !a[name].empty());
  };
  if (given("value") == given("filename")) {
    c.report.error(a.where(), "<spectrum> needs either \"value\" or \"filename\"");
    return Broken{};
  }
  if (given("filename")) return read_spectrum_file(c, a);

  const SourceLocation& where = a.where("value");
  if (a["value"].find(':') == std::string::npos) {
    const auto numbers = parse_numbers(a["value"]);
    if (numbers && numbers->size() == 1) return ScalarSpectrum{(*numbers)[0]};
    if (numbers && numbers->size() == 3 && c.version.is_0x())
      return RgbColor{{(*numbers)[0], (*numbers)[1], (*numbers)[2]}};
    c.report.error(where, "{} is not a spectrum: neither a number nor wavelength:value, …",
                   in_quotes(a["value"]));
    return Broken{};
  }
  std::vector<SpectrumSample> samples;
  for (std::string_view part : split_list(a["value"])) {
    const size_t colon = part.find(':');
    const auto wavelength = parse_number(part.substr(0, colon));
    const auto value = colon == part.npos ? std::nullopt : parse_number(part.substr(colon + 1));
    if (!wavelength || !value) {
      c.report.error(where, "{} is not of the form wavelength:value", in_quotes(part));
      return Broken{};
    }
    samples.push_back({*wavelength, *value});
  }
  return checked_spectrum(c, where, std::move(samples));
}

PropertyValue read_blackbody(const ElementContext& c, const Attributes& a) {
  if (!a.check({"!name", "!temperature", "scale"})) return Broken{};
  std::string_view text = trim(a["temperature"]);
  if (text.ends_with('K') || text.ends_with('k')) text.remove_suffix(1);
  const auto kelvin = parse_number(text);
  const auto scale = a.has("scale") ? parse_number(a["scale"]) : 1.0;
  if (!kelvin || !(*kelvin > 0))
    c.report.error(a.where("temperature"), "{} is not a temperature in kelvin",
                   in_quotes(a["temperature"]));
  if (!scale) c.report.error(a.where("scale"), "{} is not a number", in_quotes(a["scale"]));
  if (!kelvin || !(*kelvin > 0) || !scale) return Broken{};
  return Blackbody{*kelvin, *scale};
}

/// <boolean>, <integer>, <float>.
template <class T>
PropertyValue read_simple(const ElementContext& c, const Attributes& a,
                          std::optional<T> (*parse)(std::string_view), std::string_view what) {
  if (!a.check({"!name", "!value"})) return Broken{};
  if (const auto value = parse(a["value"])) return *value;
  c.report.error(a.where("value"), "{} is not {}", in_quotes(a["value"]), what);
  return Broken{};
}

}  // namespace

const std::vector<std::string>& value_elements() {
  static const std::vector<std::string> tags{
      "boolean", "integer",  "float",     "string",    "point",     "vector", "rgb",
      "srgb",    "spectrum", "blackbody", "transform", "animation", "null"};
  return tags;
}

bool is_value_element(std::string_view tag) {
  const auto& tags = value_elements();
  return std::find(tags.begin(), tags.end(), tag) != tags.end();
}

PropertyValue read_value(const ElementContext& c, pugi::xml_node element, const Attributes& a) {
  const std::string_view tag = element.name();
  if (tag != "transform" && tag != "animation")
    for (pugi::xml_node child : element.children())
      if (child.type() == pugi::node_element) {
        c.report.error(c.xml.where(child), "<{}> cannot stand in a <{}>", child.name(), tag);
        return Broken{};
      }
  if (tag == "float") return read_simple(c, a, parse_number, "a finite number");
  if (tag == "integer") return read_simple(c, a, parse_integer, "an integer");
  if (tag == "boolean") return read_simple(c, a, parse_boolean, "true or false");
  if (tag == "string") {
    if (!a.check({"!name", "!value"})) return Broken{};
    return a["value"];
  }
  if (tag == "point" || tag == "vector") return read_triple(c, a);
  if (tag == "rgb" || tag == "srgb") return read_rgb(c, a, tag == "srgb");
  if (tag == "spectrum") return read_spectrum(c, a);
  if (tag == "blackbody") return read_blackbody(c, a);
  if (tag == "transform" || tag == "animation") {
    const bool good = a.check({"!name"});
    const bool uv = snake_case(a["name"]) == "to_uv";
    PropertyValue value =
        tag == "transform"
            ? read_transform(c, element, uv ? TransformSpace::uv : TransformSpace::world)
            : read_animation(c, element);
    return good ? value : PropertyValue(Broken{});
  }
  return a.check({"name"}) ? PropertyValue(NullReference{}) : PropertyValue(Broken{});
}

}  // namespace duet
