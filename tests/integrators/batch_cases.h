// Scenes for the batches of paths, and what their images are held against.
#pragma once

#include "integrators/camera_integrator.h"
#include "support/transport_scene.h"

namespace duet::test {

inline constexpr int kSize = 40;

inline const std::string kLamp = lamp_xml("0.4", "9,8,7");
inline const std::string kEnvironment =
    "<emitter type='constant'><rgb name='radiance' value='0.3,0.4,0.5'/></emitter>";
inline const std::string kPlastic =
    "<bsdf type='roughplastic'><float name='alpha' value='0.2'/>"
    "<rgb name='diffuse_reflectance' value='0.2,0.5,0.3'/></bsdf>";
inline const std::string kTwoSidedPlastic = "<bsdf type='twosided'>" + kPlastic + "</bsdf>";
/// Rough plastic with the other facets, which batches scatter in lanes.
std::string ggx_plastic(const std::string& parameters, bool two_sided = true);
inline const std::string kCheckerColours =
    "<texture type='checkerboard' name='diffuse_reflectance'><rgb name='color0' "
    "value='0.8,0.3,0.2'/><rgb name='color1' value='0,0,0'/><transform name='to_uv'>"
    "<scale x='5' y='7'/></transform></texture>";
inline const std::string kVarnishedCheckers =
    ggx_plastic("<boolean name='nonlinear' value='true'/>" + kCheckerColours);
inline const std::string kTinted = ggx_plastic(
    "<float name='alpha' value='0.02'/><float name='int_ior' value='1.9'/>"
    "<rgb name='specular_reflectance' value='0.9,0.5,0.2'/>",
    false);
/// Inside denser than outside: total reflection.
inline const std::string kBubble =
    ggx_plastic("<float name='int_ior' value='1'/><float name='ext_ior' value='1.4'/>");

std::string smooth_plastic(const std::string& parameters, bool two_sided = true);

std::string rough_glass(const std::string& parameters);

/// Rough metal, which batches scatter in lanes, too.
std::string conductor(const std::string& parameters, bool two_sided = true);
inline const std::string kPatternedMetal = conductor(
    "<string name='distribution' value='ggx'/><string name='material' value='Cu'/>"
    "<texture type='checkerboard' name='specular_reflectance'>"
    "<rgb name='color0' value='0.8,0.3,0.9'/><rgb name='color1' value='0,0,0'/>"
    "<transform name='to_uv'><scale x='5' y='7'/></transform></texture>");
inline const std::string kAluminium =
    conductor("<string name='material' value='Al'/><float name='alpha' value='0.05'/>", false);
inline const std::string kMirrorFacets =
    conductor("<string name='material' value='none'/><float name='alpha' value='0.5'/>");
inline const std::string kBrushed = conductor(
    "<string name='material' value='Au'/><float name='alpha_u' value='0.1'/>"
    "<float name='alpha_v' value='0.4'/>");

/// Burley's material, which batches scatter in lanes as long as nothing but its colour varies.
std::string principled(const std::string& parameters, bool two_sided = true);
inline const std::string kBurleyCheckers = principled(
    "<float name='roughness' value='0.4'/><float name='spec_tint' value='0.3'/>"
    "<texture type='checkerboard' name='base_color'><rgb name='color0' value='0.8,0.3,0.2'/>"
    "<rgb name='color1' value='0,0,0'/><transform name='to_uv'><scale x='5' y='7'/></transform>"
    "</texture>");
inline const std::string kBurleyMetal = principled(
    "<rgb name='base_color' value='0.9,0.5,0.3'/><float name='roughness' value='0.3'/>"
    "<float name='metallic' value='0.8'/>",
    false);
inline const std::string kBurleyCloth = principled(
    "<rgb name='base_color' value='0.2,0.3,0.7'/><float name='sheen' value='0.8'/>"
    "<float name='sheen_tint' value='0.6'/><float name='flatness' value='0.5'/>");

std::string emitter(const std::string& type, const std::string& transform);
inline const std::string kDiskLamp =
    emitter("disk", "<scale x='0.3' y='0.2'/><rotate x='1' angle='170'/><translate z='1.9'/>");

/// A mesh whose shading normals are not those of its triangles.
std::string lumpy_xml(const std::string& center, const std::string& bsdf);

/// A sphere whose normals point inwards.
std::string hollow_xml(const std::string& center, const std::string& radius,
                       const std::string& bsdf);

inline const std::string kGlass = "<bsdf type='dielectric'/>";
inline const std::string kMirror =
    "<bsdf type='conductor'><string name='material' value='Cu'/></bsdf>";
inline const std::string kCheckers =
    "<bsdf type='twosided'><bsdf type='diffuse'><texture type='checkerboard' name='reflectance'>"
    "<rgb name='color0' value='0.8,0.3,0.2'/><rgb name='color1' value='0.2,0.3,0.7'/>"
    "<transform name='to_uv'><scale x='5' y='7'/></transform></texture></bsdf></bsdf>";
/// Opaque in part, so that paths pass straight through.
inline const std::string kMask =
    "<bsdf type='mask'><float name='opacity' value='0.6'/>" + grey("0.7") + "</bsdf>";

std::string camera(const std::string& type = "perspective", const std::string& extra = "");

struct BatchCase {
  const char* name;
  std::string content;

  TransportScene scene() const { return {TemporaryDirectory(), content}; }
};

extern const std::vector<BatchCase> kBatchCases;

RenderRequest batch_request(int spp, SampleSequence sequence, int threads = 2);

/// Numbers of an image that differ from those of another by more than rounding.
int differences(const Image& a, const Image& b);

/// Many surfaces that lie in one plane: which of them a ray meets may depend on the rays beside it.
std::string coplanar();

}  // namespace duet::test
