// What the layers of EXR files are called: as Duet calls them, or as other programs do.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace duet {

enum class AovNames {
  duet,
  blender,  ///< of multi-layer files: "ViewLayer.Normal.X"
  nuke,     ///< "N.red"
  mitsuba,  ///< of the `aov` plugin's types: "sh_normal.X"
};
inline constexpr std::string_view kAovNames[] = {"duet", "blender", "nuke", "mitsuba"};
std::optional<AovNames> aov_names_of(std::string_view name);

/// What a program calls the channels of an image, which are in Duet's words. Only names change.
/// Layers that a scene calls otherwise than `--aov` does keep their own, as far as the program can
/// read those. Throws std::invalid_argument if two channels would have one name. Sources: Blender,
/// the passes of Cycles as its multi-layer files have them; Nuke, ExrChannelNameToNuke.cpp of the
/// NDK, and its channel depth.Z; Mitsuba 3, aov.cpp.
std::vector<std::string> channels_in(AovNames names, const std::vector<std::string>& channels);

/// Names of the colours in files with Blender's names, "ViewLayer.Combined.R", become "R" and so
/// on, if the image has no others.
void take_combined_as_colours(std::vector<std::string>& channels);

}  // namespace duet
