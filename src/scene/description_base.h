// What all parts of a scene description are written with.
#pragma once

#include <cstdint>
#include <string>
#include <type_traits>
#include <variant>

#include "base/diagnostics.h"
#include "math/spectrum.h"

namespace duet {

/// Indices into the arrays of a SceneDescription.
enum class TextureId : uint32_t {};
enum class MaterialId : uint32_t {};
enum class VolumeId : uint32_t {};
enum class PhaseId : uint32_t {};
enum class MediumId : uint32_t {};
template <class T>
inline constexpr bool kIsId =
    std::is_same_v<T, TextureId> || std::is_same_v<T, MaterialId> || std::is_same_v<T, VolumeId> ||
    std::is_same_v<T, PhaseId> || std::is_same_v<T, MediumId>;

/// A parameter that is either a constant or a texture.
using ColorInput = std::variant<Spectrum, TextureId>;
using FloatInput = std::variant<double, TextureId>;

/// How a thing is called in the file, for messages; it does not count in comparisons.
struct Label {
  std::string text;
  friend bool operator==(const Label&, const Label&) { return true; }
};

}  // namespace duet
