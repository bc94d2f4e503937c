// A catalogue of the stability table with a ball under a white sky, for tests of it.
#pragma once

#include <nlohmann/json.hpp>

namespace duet::test {

/// The scene of the row: a diffuse ball that reflects `$albedo` of what falls on it, all by
/// default.
inline constexpr const char* kBallScene = R"(<scene version="3.0.0">
<default name="albedo" value="1"/>
<integrator type="path"/>
<sensor type="perspective"><float name="fov" value="40"/>
  <transform name="to_world"><lookat origin="0,0,4" target="0,0,0" up="0,1,0"/></transform>
  <film type="hdrfilm"><integer name="width" value="8"/><integer name="height" value="8"/>
    <rfilter type="box"/></film></sensor>
<shape type="sphere"><bsdf type="diffuse"><rgb name="reflectance" value="$albedo"/></bsdf></shape>
<emitter type="constant"/>
</scene>)";

/// A row that holds for all methods, of the scene in the folder "ball".
inline nlohmann::json ball_row() {
  return {{"name", "ball"},
          {"number", 19},
          {"title", "A white ball is seen"},
          {"check", "energy"},
          {"scene", "ball"},
          {"spp", 8},
          {"batches", 8},
          {"margin", 0.02},
          {"reference", {{"value", 1}}},
          {"methods", {{"*", "holds"}}}};
}

}  // namespace duet::test
