// Where the images of Duet and Mitsuba differ because Mitsuba is off.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "scene/description.h"
#include "scene/features.h"

namespace duet {

/// A construct that Mitsuba is known to render otherwise than it is defined. The texts are those of
/// docs/compatibility.md.
struct MitsubaDifference {
  std::string_view id;
  std::string_view construct;  ///< what a scene has to have
  std::string_view mitsuba;    ///< what Mitsuba makes of it; a sentence
  std::string_view measured;   ///< how far it is off, and in what
  std::string_view reason;     ///< why Duet is believed
  /// Whether a scene has the construct; `features` are the scene's.
  bool (*met)(const SceneDescription& scene, const SceneFeatures& features);
};

/// All that are known.
std::span<const MitsubaDifference> mitsuba_differences();

/// Those that a scene meets, in the same order.
std::vector<const MitsubaDifference*> mitsuba_differences(const SceneDescription& scene,
                                                          const SceneFeatures& features);

/// The last section of docs/compatibility.md. It ends with a line feed.
std::string mitsuba_differences_markdown();

}  // namespace duet
