// A directory with small scenes in which the program is run.
#pragma once

#include <string>
#include <vector>

#include "support/process.h"
#include "support/texts.h"

namespace duet::test {

/// What a program is called with.
using Arguments = std::vector<std::string>;
Arguments operator+(Arguments a, const Arguments& b);

/// Parts of a scene that tests replace.
struct TinyScene {
  std::string version = "3.0.0";
  std::string integrator =
      R"(<integrator type="path"><integer name="max_depth" value="4"/></integrator>)";
  std::string film = R"(<film type="hdrfilm"><integer name="width" value="16"/>
    <integer name="height" value="12"/><rfilter type="box"/></film>)";
  std::string extra;

  /// A diffuse square, 4 × 3 units of which fill the image, under a point light.
  std::string text() const;
};

/// A scene whose images keep all bits.
TinyScene exact_scene();

/// Light within a white sphere: there is no end to what can be computed.
TinyScene endless_scene();

class Workplace : public TemporaryDirectory {
 public:
  std::string scene(const std::string& name = "tiny.xml", const TinyScene& s = {}) const;
  Outcome run(const Arguments& arguments) const;
  bool has(const std::string& name) const;
};

}  // namespace duet::test
