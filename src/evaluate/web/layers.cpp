#include "evaluate/web/layers.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "image/channel_names.h"

namespace duet {

namespace {

using Triple = std::array<int, 3>;

/// The channels R, G and B of a layer, or what it has in their place; `prefix` is what stands
/// before their own names.
Triple colours_of(const Image& image, const std::string& prefix) {
  constexpr std::array<const char*, 3> kNames[] = {
      {"R", "G", "B"}, {"X", "Y", "Z"}, {"r", "g", "b"}, {"x", "y", "z"}, {"red", "green", "blue"}};
  for (const auto& names : kNames) {
    Triple found{};
    for (size_t i = 0; i < 3; ++i) found[i] = image.find_channel(prefix + names[i]);
    if (std::all_of(found.begin(), found.end(), [](int c) { return c >= 0; })) return found;
  }
  return {-1, -1, -1};
}

Image picked(const Image& image, const Triple& channels) {
  Image out(image.width, image.height, {"R", "G", "B"});
  const size_t pixels = size_t(image.width) * size_t(image.height), all = image.channels.size();
  for (size_t i = 0; i < pixels; ++i)
    for (size_t c = 0; c < 3; ++c) out.data[3 * i + c] = image.data[i * all + size_t(channels[c])];
  return out;
}

}  // namespace

std::vector<ViewedImage> viewed_layers(const Image& image, int longest) {
  std::vector<ViewedImage> views;
  for (int c = 0; c < image.channel_count(); ++c) {
    const std::string& channel = image.channels[size_t(c)];
    const std::string layer = layer_of(channel);
    Triple channels = colours_of(image, layer.empty() ? "" : layer + ".");
    std::string name = layer.empty() ? "colours" : layer;
    if (std::find(channels.begin(), channels.end(), c) == channels.end())
      channels = {c, c, c}, name = channel;
    else if (*std::min_element(channels.begin(), channels.end()) != c)
      continue;  // shown with the first of them
    ViewedImage view{name, "", web_image(picked(image, channels), longest), {}};
    if (view.image.reduced_by > 1)
      view.note = fmt::format("means of {0} × {0} pixels", view.image.reduced_by);
    views.push_back(std::move(view));
  }
  return views;
}

}  // namespace duet
