#include "integrators/parameters.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <iterator>
#include <limits>
#include <stdexcept>
#include <utility>

namespace duet {

namespace {

using Parameters = std::vector<MethodParameter>;

constexpr int kMaxDepth = std::numeric_limits<int>::max();
/// Of samples, sub-paths, connections and segments: as many as the reader of scene files allows.
constexpr int kMost = 1 << 16;

[[noreturn]] void refuse(const std::string& name, const std::string& needs,
                         const std::string& text) {
  throw std::invalid_argument(
      fmt::format("parameter \"{}\" needs {}, not \"{}\"", name, needs, text));
}

template <class T>
bool parse(const std::string& text, T& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size();
}

MethodParameter integer(const std::string& name, int& value, int least, int most) {
  return {name, [&value] { return fmt::to_string(value); },
          [&value, name, least, most](const std::string& text) {
            int number = 0;
            if (!parse(text, number) || number < least || number > most)
              refuse(name, fmt::format("a whole number from {} to {}", least, most), text);
            value = number;
          }};
}

/// A number from 0 to `most`; 0 itself only if that is `allowed`.
MethodParameter real(const std::string& name, double& value, bool allowed, double most) {
  return {name, [&value] { return fmt::to_string(value); },
          [&value, name, allowed, most](const std::string& text) {
            double number = -1;
            if (!parse(text, number) || !(allowed ? number >= 0 : number > 0) || !(number <= most))
              refuse(name,
                     fmt::format("a number {} {}", allowed ? "from 0 to" : "above 0, up to", most),
                     text);
            value = number;
          }};
}

MethodParameter boolean(const std::string& name, bool& value) {
  return {name, [&value] { return std::string(value ? "true" : "false"); },
          [&value, name](const std::string& text) {
            if (text != "true" && text != "1" && text != "false" && text != "0")
              refuse(name, "true or false", text);
            value = text == "true" || text == "1";
          }};
}

MethodParameter light_selection(LightSelection& value) {
  return {"light_selection", [&value] { return std::string(kLightSelectionNames[size_t(value)]); },
          [&value](const std::string& text) {
            const auto at =
                std::find(std::begin(kLightSelectionNames), std::end(kLightSelectionNames), text);
            if (at == std::end(kLightSelectionNames))
              refuse("light_selection", "auto, bvh, power or uniform", text);
            value = LightSelection(at - std::begin(kLightSelectionNames));
          }};
}

MethodParameter reuse_weights(ReuseWeights& value) {
  return {"weights",
          [&value] { return std::string(value == ReuseWeights::exact ? "exact" : "thesis"); },
          [&value](const std::string& text) {
            if (text == "exact")
              value = ReuseWeights::exact;
            else if (text != "thesis")
              refuse("weights", "exact or thesis", text);
            else if (value == ReuseWeights::exact)
              value = ReuseWeights::thesis_b;
          }};
}

MethodParameter thesis_reading(ReuseWeights& value) {
  return {"thesis_reading",
          [&value] {
            return std::string(value == ReuseWeights::exact      ? ""
                               : value == ReuseWeights::thesis_a ? "a"
                                                                 : "b");
          },
          [&value](const std::string& text) {
            if (text != "a" && text != "b") refuse("thesis_reading", "a or b", text);
            if (value == ReuseWeights::exact)
              throw std::invalid_argument("parameter \"thesis_reading\" needs weights=thesis");
            value = text == "a" ? ReuseWeights::thesis_a : ReuseWeights::thesis_b;
          }};
}

Parameters path_parameters(PathLimits& d) {
  return {integer("max_depth", d.max_depth, -1, kMaxDepth),
          integer("rr_depth", d.rr_depth, 1, kMaxDepth), boolean("hide_emitters", d.hide_emitters),
          boolean("strict_normals", d.strict_normals), light_selection(d.light_selection)};
}

Parameters parameters(PathIntegratorDescription& d) {
  Parameters p = path_parameters(d);
  p.push_back(boolean("only_specular", d.only_specular));
  p.push_back(integer("pixel_group", d.pixel_group, 1, kMostInGroup));
  return p;
}

Parameters parameters(VolumePathIntegratorDescription& d) {
  return path_parameters(d);
}

Parameters parameters(AutoIntegratorDescription& d) {
  return path_parameters(d);
}

Parameters parameters(DirectIntegratorDescription& d) {
  return {integer("emitter_samples", d.emitter_samples, 0, kMost),
          integer("bsdf_samples", d.bsdf_samples, 0, kMost),
          boolean("hide_emitters", d.hide_emitters), boolean("strict_normals", d.strict_normals),
          light_selection(d.light_selection)};
}

Parameters parameters(OcclusionIntegratorDescription& d) {
  return {integer("shading_samples", d.shading_samples, 1, kMost),
          real("ray_length", d.ray_length, true, double(std::numeric_limits<float>::max()))};
}

Parameters parameters(DepthIntegratorDescription&) {
  return {};
}

Parameters parameters(BidirectionalIntegratorDescription& d) {
  using enum BidirectionalMethod;
  Parameters all{integer("max_depth", d.max_depth, -1, kMaxDepth),
                 integer("rr_depth", d.rr_depth, 1, kMaxDepth),
                 boolean("hide_emitters", d.hide_emitters)};
  const auto add = [&all](MethodParameter p) { all.push_back(std::move(p)); };
  if (d.method != ptracer) {
    add(boolean("strict_normals", d.strict_normals));
    add(light_selection(d.light_selection));
  }
  add(real("light_paths", d.light_paths, true, kMost));
  add(boolean("guide_emission", d.guide_emission));
  if (d.method == bdpt || d.method == vcm) add(integer("connections", d.connections, -1, kMost));
  if (d.method == bdpt) {
    add(boolean("light_image", d.light_image));
    add(integer("pixel_group", d.pixel_group, 1, kMostInGroup));
  }
  if (d.method == ppm || d.method == bpm || d.method == vcm) {
    add(real("radius", d.radius, true, double(std::numeric_limits<float>::max())));
    add(real("alpha", d.alpha, true, 1));
  }
  if (d.method == reuse) {
    add(integer("max_eye_depth", d.max_eye_depth, 0, kMost));
    add(integer("max_light_depth", d.max_light_depth, 0, kMost));
    add(reuse_weights(d.weights));
    add(thesis_reading(d.weights));
    add(real("continue_probability", d.continue_probability, false, 1));
  }
  return all;
}

}  // namespace

Parameters method_parameters(IntegratorDescription& integrator) {
  return std::visit([](auto& method) { return parameters(method); }, integrator.method);
}

}  // namespace duet
