// What an element of a scene file may say of a parameter, and the version by which it is meant.
#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "math/motion.h"
#include "values/color.h"

namespace duet {

/// Version of the file that an element stands in; it decides what names and numbers mean.
struct FileVersion {
  int major = 3, minor = 0, patch = 0;
  auto operator<=>(const FileVersion&) const = default;
  /// Mitsuba 0.4 to 0.6.
  bool is_0x() const { return major < 2; }
};

using Triple = std::array<double, 3>;
inline Spectrum to_spectrum(const Triple& t) {
  return {float(t[0]), float(t[1]), float(t[2])};
}

/// A property that could not be read: the error is reported, nothing more is to be said about it.
struct Broken {};
struct RgbColor {
  Triple value{};
};
/// <spectrum> with a single number.
struct ScalarSpectrum {
  double value = 0;
};
struct Blackbody {
  double kelvin = 0, scale = 1;
};
/// <null/>: nothing, on purpose.
struct NullReference {};
/// A plugin, nested or by reference; no element of a value has one.
struct Node;

using PropertyValue = std::variant<Broken, bool, int64_t, double, std::string, Triple, RgbColor,
                                   ScalarSpectrum, std::vector<SpectrumSample>, Blackbody, Matrix4,
                                   Motion, const Node*, NullReference>;

}  // namespace duet
