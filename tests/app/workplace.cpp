#include "app/workplace.h"

namespace duet::test {

Arguments operator+(Arguments a, const Arguments& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

std::string TinyScene::text() const {
  return "<scene version=\"" + version + "\">\n<default name=\"spp\" value=\"4\"/>\n" + integrator +
         R"(
<sensor type="perspective"><float name="fov" value="90"/>
  <transform name="to_world"><lookat origin="0,0,2" target="0,0,0" up="0,1,0"/></transform>
  <sampler type="independent"><integer name="sample_count" value="$spp"/></sampler>
)" + film +
         R"(
</sensor>
<shape type="rectangle"><transform name="to_world"><scale value="3"/></transform>
  <bsdf type="diffuse"><rgb name="reflectance" value="0.8, 0.4, 0.2"/></bsdf></shape>
<emitter type="point"><point name="position" x="0" y="0" z="3"/>
  <rgb name="intensity" value="20"/></emitter>
)" + extra +
         "</scene>\n";
}

TinyScene exact_scene() {
  TinyScene s;
  s.film = R"(<film type="hdrfilm"><integer name="width" value="16"/>
    <integer name="height" value="12"/><string name="component_format" value="float32"/></film>)";
  return s;
}

TinyScene endless_scene() {
  TinyScene s;
  s.integrator = R"(<integrator type="path"><integer name="rr_depth" value="100"/></integrator>)";
  s.film = R"(<film type="hdrfilm"><integer name="width" value="64"/>
    <integer name="height" value="64"/><rfilter type="box"/></film>)";
  s.extra = R"(<shape type="sphere"><float name="radius" value="9"/>
    <bsdf type="twosided"><bsdf type="diffuse"><rgb name="reflectance" value="0.9"/></bsdf></bsdf>
    </shape>)";
  return s;
}

std::string Workplace::scene(const std::string& name, const TinyScene& s) const {
  return write(name, s.text());
}

Outcome Workplace::run(const Arguments& arguments) const {
  return run_duet(arguments, {.directory = path("")});
}

bool Workplace::has(const std::string& name) const {
  return std::filesystem::exists(path(name));
}

}  // namespace duet::test
