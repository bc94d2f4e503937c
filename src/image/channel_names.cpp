#include "image/channel_names.h"

#include <cctype>

namespace duet {

std::string layer_of(const std::string& channel) {
  const size_t dot = channel.rfind('.');
  return dot == channel.npos ? "" : channel.substr(0, dot);
}

std::string part_name(const std::vector<std::string>& channels, size_t channel) {
  if (std::string layer = layer_of(channels[channel]); !layer.empty()) return layer;
  std::string name;
  for (const std::string& c : channels)
    if (layer_of(c).empty())
      for (const char letter : c) name += char(std::tolower(static_cast<unsigned char>(letter)));
  return name;
}

}  // namespace duet
