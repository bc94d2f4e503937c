#include "integrators/batch_cases.h"
#include "support/source_path.h"

namespace duet::test {

std::string ggx_plastic(const std::string& parameters, bool two_sided) {
  const std::string plastic =
      "<bsdf type='roughplastic'><string name='distribution' value='ggx'/>" + parameters +
      "</bsdf>";
  return two_sided ? "<bsdf type='twosided'>" + plastic + "</bsdf>" : plastic;
}

std::string smooth_plastic(const std::string& parameters, bool two_sided) {
  const std::string plastic = "<bsdf type='plastic'>" + parameters + "</bsdf>";
  return two_sided ? "<bsdf type='twosided'>" + plastic + "</bsdf>" : plastic;
}

std::string rough_glass(const std::string& parameters) {
  return "<bsdf type='roughdielectric'>" + parameters + "</bsdf>";
}

std::string conductor(const std::string& parameters, bool two_sided) {
  const std::string metal = "<bsdf type='roughconductor'>" + parameters + "</bsdf>";
  return two_sided ? "<bsdf type='twosided'>" + metal + "</bsdf>" : metal;
}

std::string principled(const std::string& parameters, bool two_sided) {
  const std::string burley = "<bsdf type='principled'>" + parameters + "</bsdf>";
  return two_sided ? "<bsdf type='twosided'>" + burley + "</bsdf>" : burley;
}

std::string emitter(const std::string& type, const std::string& transform) {
  return "<shape type='" + type + "'><transform name='to_world'>" + transform +
         "</transform><emitter type='area'><rgb name='radiance' value='5,7,4'/></emitter></shape>";
}

std::string lumpy_xml(const std::string& center, const std::string& bsdf) {
  return "<shape type='serialized'><string name='filename' value='" +
         source_path("scenes/mesh-lumpy/lumpy.serialized") +
         "'/><transform name='to_world'><scale value='0.3'/>"
         "<translate value='" +
         center + "'/></transform>" + bsdf + "</shape>";
}

std::string hollow_xml(const std::string& center, const std::string& radius,
                       const std::string& bsdf) {
  return sphere_xml(center, radius, "<boolean name='flip_normals' value='true'/>" + bsdf);
}

std::string camera(const std::string& type, const std::string& extra) {
  return camera_xml("0,-3.2,1", "0,0,1", kSize, type, extra);
}

RenderRequest batch_request(int spp, SampleSequence sequence, int threads) {
  RenderRequest r;
  r.budget.spp = spp;
  r.seed = 7;
  r.sequence = sequence;
  r.threads = threads;
  return r;
}

int differences(const Image& a, const Image& b) {
  REQUIRE(a.data.size() == b.data.size());
  int count = 0;
  for (size_t i = 0; i < a.data.size(); ++i)
    count += std::abs(a.data[i] - b.data[i]) > 1e-4f * (1 + std::abs(b.data[i]));
  return count;
}

std::string coplanar() {
  std::string content = camera() + kEnvironment;
  for (int i = 0; i < 40; ++i) {
    const auto number = [](double v) { return std::to_string(v); };
    content += "<shape type='rectangle'><transform name='to_world'><scale value='" +
               number(0.3 + 0.02 * i) + "'/><rotate z='1' angle='" + number(90 * (i % 4)) +
               "'/><translate x='" + number(0.25 * (i % 7) - 0.75) + "' y='" +
               number(0.25 * (i % 5) - 0.5) + "'/></transform>" +
               grey(number(0.02 * i) + "," + number(0.9 - 0.02 * i) + ",0.5") + "</shape>";
  }
  return content;
}

const std::vector<BatchCase> kBatchCases = {
    {"a diffuse room under one lamp", camera() + room_xml(grey("0.3,0.7,0.8")) + kLamp},
    {"two lamps and an environment",
     camera() + room_xml(grey("0.6")) + kLamp +
         sphere_xml("0.4,0.2,0.3", "0.1",
                    "<emitter type='area'><rgb name='radiance' value='5,9,2'/></emitter>") +
         kEnvironment},
    {"a point light through a lens",
     camera("thinlens",
            "<float name='aperture_radius' value='0.1'/>"
            "<float name='focus_distance' value='3'/>") +
         room_xml(grey("0.6")) +
         "<emitter type='point'><point name='position' x='0' y='0' z='1.5'/>"
         "<rgb name='intensity' value='3,2,1'/></emitter>"},
    {"plastic, glass and masks on meshes and spheres",
     camera() + room_xml(grey("0.6")) + kLamp + sphere_xml("-0.4,0.2,0.4", "0.35", kPlastic) +
         sphere_xml("0.4,-0.2,0.4", "0.3", kGlass) +
         "<shape type='cube'><transform name='to_world'><scale value='0.2'/><rotate z='1' "
         "angle='30'/><translate y='-0.5' z='1.2'/></transform>" +
         kMask + "</shape>"},
    {"a round lamp", camera() + room_xml(grey("0.6")) + kDiskLamp},
    {"lamps of many kinds",
     camera() + room_xml(grey("0.6")) + kLamp + kDiskLamp +
         emitter("rectangle",
                 "<scale value='0.1'/><rotate y='1' angle='90'/>"
                 "<translate x='-0.9' z='1'/>") +
         emitter("disk",
                 "<scale value='0.1'/><rotate y='1' angle='-80'/>"
                 "<translate x='0.9' z='0.5'/>") +
         emitter("cube", "<scale value='0.05'/><translate x='0.3' z='0.3'/>") +
         emitter("sphere", "<scale value='0.05'/><translate x='-0.3' z='0.4'/>")},
    {"lamps that are meshes, with and without a tree of triangles",
     camera() + room_xml(grey("0.6")) +
         lumpy_xml("-0.4,0.2,0.9",
                   "<emitter type='area'><rgb name='radiance' value='5,7,4'/></emitter>") +
         emitter("cube",
                 "<scale value='0.1'/><rotate x='1' y='1' angle='40'/>"
                 "<translate x='0.4' z='0.5'/>")},
    {"balls that shine, one seen from within",
     camera() + room_xml(grey("0.6")) +
         emitter("sphere", "<scale value='0.35'/><translate x='-0.5' y='0.3' z='0.4'/>") +
         emitter("sphere", "<scale value='0.002'/><translate x='0.4' y='-0.2' z='1.3'/>") +
         emitter("sphere", "<scale value='9'/>")},
    {"rough plastics in lanes",
     camera() + room_xml(kVarnishedCheckers) + kLamp + sphere_xml("-0.4,0.2,0.4", "0.35", kTinted) +
         sphere_xml("0.5,-0.3,0.3", "0.25", kBubble) + hollow_xml("0.5,0.3,1.2", "0.3", kTinted) +
         "<shape type='cube'><transform name='to_world'><scale value='0.2'/><rotate z='1' "
         "angle='30'/><translate y='-0.5' z='1.2'/></transform>" +
         ggx_plastic("<rgb name='diffuse_reflectance' value='0.2,0.5,0.3'/>", false) + "</shape>"},
    {"rough metals in lanes",
     camera() + room_xml(kPatternedMetal) + kLamp + sphere_xml("-0.4,0.2,0.4", "0.35", kAluminium) +
         hollow_xml("0.5,-0.3,0.3", "0.25", kMirrorFacets) +
         hollow_xml("0.5,0.3,1.2", "0.3", kAluminium) +
         "<shape type='cube'><transform name='to_world'><scale value='0.2'/><rotate z='1' "
         "angle='30'/><translate y='-0.5' z='1.2'/></transform>" +
         kBrushed + "</shape>"},
    {"Beckmann plastics and metals in lanes",
     camera() + room_xml(kTwoSidedPlastic) + kLamp + sphere_xml("-0.4,0.2,0.4", "0.35", kPlastic) +
         hollow_xml("0.5,-0.3,0.3", "0.25", kTwoSidedPlastic) +
         "<shape type='cube'><transform name='to_world'><scale value='0.2'/><rotate z='1' "
         "angle='30'/><translate y='-0.5' z='1.2'/></transform>" +
         kAluminium + "</shape>"},
    {"Burley's materials in lanes",
     camera() + room_xml(kBurleyCheckers) + kLamp + lumpy_xml("-0.4,0.2,0.5", kBurleyMetal) +
         hollow_xml("0.5,-0.3,0.3", "0.25", kBurleyCloth) +
         hollow_xml("0.5,0.3,1.2", "0.3", kBurleyMetal) +
         "<shape type='cube'><transform name='to_world'><scale value='0.2'/><rotate z='1' "
         "angle='30'/><translate y='-0.5' z='1.2'/></transform>" +
         kBurleyCloth + "</shape>"},
    {"smooth plastics",
     camera() + room_xml(smooth_plastic(kCheckerColours)) + kLamp +
         lumpy_xml("-0.4,0.2,0.5", smooth_plastic("<float name='int_ior' value='1.9'/>", false)) +
         hollow_xml("0.5,-0.3,0.4", "0.3", smooth_plastic("", false)) +
         sphere_xml("0.4,0.3,1.2", "0.3",
                    smooth_plastic("<float name='int_ior' value='1'/><float name='ext_ior' "
                                   "value='1.4'/><boolean name='nonlinear' value='true'/>"))},
    {"rough glass in lanes",
     camera() + room_xml(grey("0.6")) + kLamp + kEnvironment +
         lumpy_xml("-0.4,0.2,0.5", rough_glass("<float name='alpha' value='0.3'/>")) +
         sphere_xml("0.5,-0.3,0.5", "0.3",
                    rough_glass("<float name='alpha' value='0.15'/>"
                                "<rgb name='specular_transmittance' "
                                "value='0.9,0.7,0.5'/>")) +
         hollow_xml("0.4,0.3,1.2", "0.3",
                    rough_glass("<string name='distribution' value='ggx'/>"
                                "<float name='alpha' value='0.2'/>")) +
         "<shape type='rectangle'><transform name='to_world'><scale value='0.4'/><rotate x='1' "
         "angle='80'/><translate x='-0.3' y='-0.8' z='0.6'/></transform>" +
         rough_glass("<float name='alpha' value='0.05'/>") + "</shape>" +
         sphere_xml("-0.4,-0.1,1.4", "0.25", kPlastic)},
    {"glass, panes and mirrors",
     camera() + room_xml(grey("0.6")) + kLamp + kEnvironment +
         lumpy_xml("-0.4,0.2,0.5",
                   "<bsdf type='dielectric'><rgb name='specular_transmittance' "
                   "value='0.9,0.7,0.8'/></bsdf>") +
         lumpy_xml("0.5,-0.3,0.5", kMirror) + hollow_xml("0.4,0.3,1.2", "0.3", kMirror) +
         hollow_xml("-0.3,-0.4,1.2", "0.25", kGlass) +
         "<shape type='rectangle'><transform name='to_world'><scale value='0.4'/><rotate x='1' "
         "angle='80'/><translate y='-0.8' z='0.6'/></transform><bsdf "
         "type='thindielectric'/></shape>"
         "<shape type='rectangle'><transform name='to_world'><scale value='0.3'/><rotate y='1' "
         "angle='100'/><translate x='0.9' z='0.9'/></transform><bsdf type='twosided'>" +
         kMirror + "</bsdf></shape>"},
    {"diffuse and glossy meshes with shading normals",
     camera() + room_xml(kVarnishedCheckers) + kLamp + lumpy_xml("-0.4,0.2,0.5", grey("0.7")) +
         lumpy_xml("0.4,-0.1,0.5", kAluminium) + lumpy_xml("0.1,0.2,1.3", kPlastic)},
    {"textures on meshes and analytic shapes",
     camera() + room_xml(kCheckers) + kLamp + sphere_xml("-0.4,0.2,0.4", "0.35", kCheckers) +
         "<shape type='disk'><transform name='to_world'><scale value='0.3'/>"
         "<rotate x='1' angle='60'/><translate x='0.4' z='1.3'/></transform>" +
         kCheckers +
         "</shape><shape type='cube'><transform name='to_world'><scale value='0.2'/>"
         "<translate x='0.3' y='-0.4' z='0.3'/></transform>" +
         kCheckers + "</shape>"},
    {"instances with smooth normals and one-sided surfaces",
     camera() +
         room_xml("<bsdf type='diffuse'><rgb name='reflectance' value='0.5,0.6,0.7'/></bsdf>") +
         kLamp + "<shape type='shapegroup' id='g'><shape type='cube'>" + grey("0.5") +
         "</shape></shape><shape type='instance'><ref id='g'/><transform name='to_world'>"
         "<scale value='0.2'/><rotate z='1' angle='30'/><translate z='0.5'/></transform></shape>"
         "<shape type='sphere'><boolean name='flip_normals' value='true'/>"
         "<point name='center' value='0.5,0.3,0.8'/><float name='radius' value='0.3'/>" +
         grey("0.4") + "</shape>"},
};

}  // namespace duet::test
