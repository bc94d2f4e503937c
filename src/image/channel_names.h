// How channels of images belong to layers.
#pragma once

#include <string>
#include <vector>

namespace duet {

/// "dd.y" of the channel "dd.y.T"; "" of one without a dot, which is of the image itself.
std::string layer_of(const std::string& channel);

/// The part of a file in which each layer is one: the name of the channel's layer. That of the
/// image itself is made of its channels, "rgba".
std::string part_name(const std::vector<std::string>& channels, size_t channel);

}  // namespace duet
