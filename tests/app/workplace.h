// A directory with small scenes in which the program is run.
#pragma once

#include <string>
#include <vector>

#include "support/process.h"

namespace duet::test {

/// Parts of a scene that tests replace.
struct TinyScene {
  std::string version = "3.0.0";
  std::string integrator =
      R"(<integrator type="path"><integer name="max_depth" value="4"/></integrator>)";
  std::string film = R"(<film type="hdrfilm"><integer name="width" value="16"/>
    <integer name="height" value="12"/><rfilter type="box"/></film>)";
  std::string extra;

  /// A diffuse square, 4 × 3 units of which fill the image, under a point light.
  std::string text() const {
    return "<scene version=\"" + version + "\">\n<default name=\"spp\" value=\"4\"/>\n" +
           integrator + R"(
<sensor type="perspective"><float name="fov" value="90"/>
  <transform name="to_world"><lookat origin="0,0,2" target="0,0,0" up="0,1,0"/></transform>
  <sampler type="independent"><integer name="sample_count" value="$spp"/></sampler>
)" + film + R"(
</sensor>
<shape type="rectangle"><transform name="to_world"><scale value="3"/></transform>
  <bsdf type="diffuse"><rgb name="reflectance" value="0.8, 0.4, 0.2"/></bsdf></shape>
<emitter type="point"><point name="position" x="0" y="0" z="3"/>
  <rgb name="intensity" value="20"/></emitter>
)" + extra +
           "</scene>\n";
  }
};

/// A scene whose images keep all bits.
inline TinyScene exact_scene() {
  TinyScene s;
  s.film = R"(<film type="hdrfilm"><integer name="width" value="16"/>
    <integer name="height" value="12"/><string name="component_format" value="float32"/></film>)";
  return s;
}

/// Light within a white sphere: there is no end to what can be computed.
inline TinyScene endless_scene() {
  TinyScene s;
  s.integrator = R"(<integrator type="path"><integer name="rr_depth" value="100"/></integrator>)";
  s.film = R"(<film type="hdrfilm"><integer name="width" value="64"/>
    <integer name="height" value="64"/><rfilter type="box"/></film>)";
  s.extra = R"(<shape type="sphere"><float name="radius" value="9"/>
    <bsdf type="twosided"><bsdf type="diffuse"><rgb name="reflectance" value="0.9"/></bsdf></bsdf>
    </shape>)";
  return s;
}

class Workplace : public TemporaryDirectory {
 public:
  std::string scene(const std::string& name = "tiny.xml", const TinyScene& s = {}) const {
    return write(name, s.text());
  }
  Outcome run(const std::vector<std::string>& arguments) const {
    return run_duet(arguments, {.directory = path("")});
  }
  bool has(const std::string& name) const { return std::filesystem::exists(path(name)); }
};

/// Whether `text` contains `part`.
inline bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace duet::test
