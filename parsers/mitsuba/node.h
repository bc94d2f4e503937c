// A scene file as a tree of plugins with their properties: what XML says, before anybody asks what
// it means.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <string>
#include <unordered_map>
#include <variant>
#include <vector>

#include "base/diagnostics.h"
#include "math/motion.h"
#include "mitsuba/vocabulary.h"
#include "values/color.h"

namespace duet {

/// Version of the file that an element stands in; it decides what names and numbers mean.
struct FileVersion {
  int major = 3, minor = 0, patch = 0;
  auto operator<=>(const FileVersion&) const = default;
  /// Mitsuba 0.4 to 0.6.
  bool is_0x() const { return major < 2; }
};

struct Node;

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

using PropertyValue = std::variant<Broken, bool, int64_t, double, std::string, Triple, RgbColor,
                                   ScalarSpectrum, std::vector<SpectrumSample>, Blackbody, Matrix4,
                                   Motion, const Node*, NullReference>;

struct Property {
  std::string name;     ///< in snake_case; empty for a nested plugin without a name
  std::string written;  ///< as the file has it
  PropertyValue value;
  SourceLocation where;        ///< of the element
  SourceLocation value_where;  ///< of the attribute with the value
};

/// One plugin: <bsdf type="diffuse"> … </bsdf>.
struct Node {
  PluginKind kind{};
  /// Null if there is no such plugin, or none that is supported: that error is reported.
  const Plugin* plugin = nullptr;
  std::string type, id;
  FileVersion version;
  SourceLocation where;
  std::vector<Property> properties;
  /// An integrator in whose place another method is run: nothing is reported about it.
  bool replaced = false;
  /// Folders in which its files are looked for, first to last; shared by a file's nodes.
  std::shared_ptr<const std::vector<std::string>> folders;
};

/// All plugins of a scene with the files it includes. The first is the scene.
struct NodeTree {
  std::deque<Node> nodes;
  std::vector<std::pair<std::string, std::string>> parameters;
  /// Whether the scene's integrator does not matter, so that it may have none.
  bool integrator_replaced = false;
};

/// `<bsdf type="diffuse">`, for messages.
std::string describe(const Node& node);

}  // namespace duet
