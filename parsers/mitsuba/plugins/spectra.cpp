// The textures of Mitsuba 3 that are the same everywhere.
#include "mitsuba/plugins/plugin.h"
#include "mitsuba/plugins/tables.h"
#include "values/spectrum_text.h"
#include "values/text.h"

namespace duet::plugins {

namespace {

/// Two lists of numbers as a spectrum; nothing after an error.
std::optional<std::vector<SpectrumSample>> samples(Properties& p, std::string_view name,
                                                   const std::vector<double>& wavelengths,
                                                   const std::vector<double>& values) {
  if (wavelengths.size() != values.size() || values.size() < 2) {
    p.error(name, "{} wavelengths and {} values make no spectrum", wavelengths.size(),
            values.size());
    return std::nullopt;
  }
  std::vector<SpectrumSample> result;
  for (size_t i = 0; i < values.size(); ++i) result.push_back({wavelengths[i], values[i]});
  if (first_not_increasing(result) == 0) return result;
  p.error(name, "the wavelengths of a spectrum must increase");
  return std::nullopt;
}

void read_uniform(SceneReader&, Properties& p, MeantColor& out) {
  out.value = Spectrum(float(p.number("value")));
}

void read_srgb(SceneReader& s, Properties& p, MeantColor& out) {
  out.value = s.constant_color(p, "color");
  if (!p.boolean("unbounded") && out.value.max() > 1)
    p.error("color",
            "a component of an \"srgb\" spectrum is greater than 1, but not \"unbounded\"");
}

void read_d65(SceneReader& s, Properties& p, MeantColor& out) {
  out.value = s.constant_color(p, "color") * float(p.number("scale"));
}

void read_rawconstant(SceneReader& s, Properties& p, MeantColor& out) {
  const Property* value = p.find("value");
  const Triple* triple = value ? std::get_if<Triple>(&value->value) : nullptr;
  if (triple)
    out.value = to_spectrum(*triple);
  else if (value)
    out.value = s.constant_color(p, "value");
}

void read_irregular(SceneReader&, Properties& p, MeantColor& out) {
  const auto wavelengths = p.numbers("wavelengths"), values = p.numbers("values");
  if (!p.has("wavelengths") || !p.has("values")) return;
  if (const auto list = samples(p, "values", wavelengths, values))
    out.value = stepped_spectrum_to_rgb(*list, out.meaning);
}

void read_regular(SceneReader&, Properties& p, MeantColor& out) {
  const double first = p.number("wavelength_min"), last = p.number("wavelength_max");
  const auto values = p.numbers("values");
  if (!p.has("wavelength_min") || !p.has("wavelength_max") || !p.has("values")) return;
  std::vector<double> wavelengths;
  for (size_t i = 0; i < values.size(); ++i)
    wavelengths.push_back(first + (last - first) * double(i) / double(values.size() - 1));
  if (const auto list = samples(p, "values", wavelengths, values))
    out.value = stepped_spectrum_to_rgb(*list, out.meaning);
}

void read_blackbody(SceneReader&, Properties& p, MeantColor& out) {
  if (const auto kelvin = p.optional_number("temperature"))
    out.value = spectrum_to_rgb(blackbody_spectrum(*kelvin, 1), out.meaning);
}

}  // namespace

std::vector<Plugin> spectra() {
  const auto required = [](std::string_view name, ParameterType type, std::string_view note,
                           NumberRange range) {
    return Parameter{name, type, "", note, range, both, done, "", "", true};
  };
  const Parameter color = required("color", unbounded, "", any);
  const Parameter wavelengths = required("wavelengths", string, "", any);
  const Parameter values = required("values", string, "", any);
  const ParameterList range = inert_parameters(number, "wavelength_min wavelength_max");
  return {
      {"uniform", v3, {Parameter{"value", number, "1"}, range}, &read_uniform},
      {"srgb", v3, {color, Parameter{"unbounded", boolean, "false"}}, &read_srgb},
      {"d65",
       v3,
       {Parameter{"color", unbounded, "1"}, Parameter{"scale", number, "1"},
        Parameter{"value", number, "1", "", any, both, inert}},
       &read_d65,
       "",
       done,
       "srgb_d65"},
      {"rawconstant", v3, required("value", unbounded, "", any), &read_rawconstant},
      {"irregular", v3, {wavelengths, values}, &read_irregular},
      {"regular",
       v3,
       {required("wavelength_min", number, "", any), required("wavelength_max", number, "", any),
        values},
       &read_regular},
      {"blackbody",
       v3,
       {required("temperature", number, "in kelvin", positive), range},
       &read_blackbody},
  };
}

}  // namespace duet::plugins
