#include "evaluate/report/aov_names.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <iterator>
#include <stdexcept>

#include "image/channel_names.h"
#include "image/cryptomatte.h"

namespace duet {

namespace {

constexpr std::string_view kCombined = ".Combined.";

/// A layer's name in each program; "" for Duet's own.
struct LayerWords {
  std::string_view duet, blender, nuke, mitsuba;
};
constexpr LayerWords kWords[] = {
    {"albedo", "DiffCol", "", ""},
    {"depth", "Depth", "", ""},
    {"position", "Position", "P", ""},
    {"uv", "UV", "", ""},
    {"normal", "Normal", "N", "sh_normal"},
    {"sh_normal", "Normal", "N", ""},
    {"geo_normal", "", "Ng", ""},
    {"shape", "IndexOB", "", "shape_index"},
    {"shape_index", "IndexOB", "", ""},
    {"samples", "Debug Sample Count", "", ""},
    {"denoise_albedo", "Denoising Albedo", "", ""},
    {"denoise_normal", "Denoising Normal", "", ""},
};

std::string layer_word(const std::string& layer, std::string_view LayerWords::*program) {
  for (const LayerWords& words : kWords)
    if (words.duet == layer && !(words.*program).empty()) return std::string(words.*program);
  return layer;
}

/// "DEPTH.T" → "T".
std::string last_word(const std::string& channel) {
  return channel.substr(channel.rfind('.') + 1);
}

/// View layer, pass and channel, with dots between them only; channels are single letters that
/// passes of one value have as X, depths as Z.
std::string blender_name(const std::string& channel) {
  const std::string layer = layer_of(channel);
  std::string letter = last_word(channel);
  if (layer.empty()) return fmt::format("ViewLayer{}{}", kCombined, letter);
  if (letter == "I") letter = "X";
  if (letter == "T") letter = "Z";
  std::string pass = layer_word(layer, &LayerWords::blender);
  std::replace(pass.begin(), pass.end(), '.', '_');
  return fmt::format("ViewLayer.{}.{}", pass, letter);
}

/// Layers are words of letters, digits and _ that begin with no digit; their channels have the
/// names of colours, in their order.
std::string nuke_name(const std::string& channel, size_t place) {
  static constexpr std::string_view kColours[] = {"red", "green", "blue", "alpha"};
  std::string layer = layer_of(channel);
  if (layer.empty()) return channel;
  if (layer == "depth") return "depth.Z";
  layer = layer_word(layer, &LayerWords::nuke);
  const auto is_plain = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0; };
  std::replace_if(
      layer.begin(), layer.end(), [&](char c) { return !is_plain(c); }, '_');
  if (std::isdigit(static_cast<unsigned char>(layer[0])) != 0) layer.insert(0, "_");
  return fmt::format("{}.{}", layer,
                     place < std::size(kColours) ? kColours[place] : last_word(channel));
}

std::string mitsuba_name(const std::string& channel) {
  const std::string layer = layer_of(channel);
  if (layer.empty()) return channel;
  return layer_word(layer, &LayerWords::mitsuba) + "." + last_word(channel);
}

}  // namespace

std::optional<AovNames> aov_names_of(std::string_view name) {
  const auto* at = std::find(std::begin(kAovNames), std::end(kAovNames), name);
  if (at == std::end(kAovNames)) return std::nullopt;
  return AovNames(at - std::begin(kAovNames));
}

std::vector<std::string> channels_in(AovNames names, const std::vector<std::string>& channels) {
  std::vector<std::string> named;
  size_t place = 0;
  for (size_t c = 0; c < channels.size(); ++c) {
    place = c > 0 && layer_of(channels[c]) == layer_of(channels[c - 1]) ? place + 1 : 0;
    std::string name = channels[c];
    // Readers look for mattes by these names.
    const bool keeps_name = is_matte_channel(channels[c]);
    if (names == AovNames::blender && !keeps_name) name = blender_name(channels[c]);
    if (names == AovNames::nuke && !keeps_name) name = nuke_name(channels[c], place);
    if (names == AovNames::mitsuba && !keeps_name) name = mitsuba_name(channels[c]);
    if (const auto other = std::find(named.begin(), named.end(), name); other != named.end())
      throw std::invalid_argument(fmt::format(
          "with the names of {}, {} and {} are both called {}", kAovNames[size_t(names)],
          channels[size_t(other - named.begin())], channels[c], name));
    named.push_back(std::move(name));
  }
  return named;
}

void take_combined_as_colours(std::vector<std::string>& channels) {
  const auto is_own = [](const std::string& c) { return layer_of(c).empty(); };
  if (std::any_of(channels.begin(), channels.end(), is_own)) return;
  std::string layer;  // the first of several view layers
  for (std::string& channel : channels) {
    const size_t at = channel.rfind(kCombined);
    if (at == channel.npos || at + kCombined.size() + 1 != channel.size()) continue;
    if (layer.empty()) layer = layer_of(channel);
    if (layer_of(channel) == layer) channel = last_word(channel);
  }
}

}  // namespace duet
