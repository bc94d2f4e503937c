#include "evaluate/batch/image_pixels.h"

#include <algorithm>
#include <charconv>

#include "evaluate/batch/pbrt_skim.h"
#include "mitsuba/loader.h"
#include "pbrt/pbrt.h"

namespace duet::batch {

namespace {

/// What pbrt's films have that do not say it.
constexpr double kPbrtWidth = 1280, kPbrtHeight = 720;

/// The numbers of a text, whatever stands between them.
std::vector<double> numbers_in(const std::string& text) {
  std::vector<double> numbers;
  const char *at = text.data(), *end = at + text.size();
  while (at < end) {
    double value = 0;
    const auto [rest, error] = std::from_chars(at, end, value, std::chars_format::fixed);
    if (error == std::errc()) numbers.push_back(value);
    at = error == std::errc() ? rest : at + 1;
  }
  return numbers;
}

/// A property of a film that is a number.
std::optional<double> film_number(const Node& film, const std::string& name) {
  for (const Property& p : film.properties) {
    if (p.name != name) continue;
    if (const auto* whole = std::get_if<int64_t>(&p.value)) return double(*whole);
    if (const auto* number = std::get_if<double>(&p.value)) return *number;
  }
  return std::nullopt;
}

std::optional<double> mitsuba_pixels(const Job& job) {
  MitsubaOptions options;
  if (const JobOption* defines = job.find("define"))
    for (const std::string& text : defines->values)
      if (const size_t equals = text.find('='); equals != text.npos)
        options.defines.emplace_back(text.substr(0, equals), text.substr(equals + 1));
  if (const JobOption* folders = job.find("path")) options.search_paths = folders->values;
  options.replacing_methods = {"path"};
  Diagnostics ignored;
  Report report(ignored);
  const NodeTree tree = load_tree(job.scene, options, with_disk({}), report);
  const FilmDescription preset;
  for (const Node& node : tree.nodes) {
    if (node.kind != PluginKind::film) continue;
    const double width = film_number(node, "width").value_or(preset.width);
    const double height = film_number(node, "height").value_or(preset.height);
    return film_number(node, "crop_width").value_or(width) *
           film_number(node, "crop_height").value_or(height);
  }
  if (ignored.has_errors()) return std::nullopt;
  return double(preset.width) * preset.height;
}

std::optional<double> pbrt_pixels(const std::string& file) {
  pbrt::Lexer in(file);
  while (in.peek() != pbrt::Kind::end) {
    if (in.peek() != pbrt::Kind::word) {
      take_parameters(in);
      continue;
    }
    const std::string directive = in.take_word();
    if (directive == "WorldBegin") break;
    if (directive != "Film") continue;
    const std::map<std::string, double> film = take_parameters(in);
    const auto number = [&](const char* name, double otherwise) {
      const auto at = film.find(name);
      return at == film.end() ? otherwise : at->second;
    };
    return number("xresolution", kPbrtWidth) * number("yresolution", kPbrtHeight);
  }
  return kPbrtWidth * kPbrtHeight;
}

}  // namespace

std::optional<double> image_pixels(const Job& job) {
  if (const auto crop = numbers_in(job.value("crop")); crop.size() == 4) return crop[2] * crop[3];
  if (const auto size = numbers_in(job.value("size")); size.size() == 2) return size[0] * size[1];
  try {
    return pbrt::is_pbrt_file(job.scene) ? pbrt_pixels(job.scene) : mitsuba_pixels(job);
  } catch (const ReadError&) {
    return std::nullopt;
  } catch (const pbrt::SyntaxError&) {
    return std::nullopt;
  }
}

}  // namespace duet::batch
