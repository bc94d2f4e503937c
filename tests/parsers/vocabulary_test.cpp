#include "mitsuba/vocabulary.h"

#include <doctest/doctest.h>

#include <set>

#include "base/diagnostics.h"
#include "values/text.h"

using namespace duet;

namespace {

std::vector<std::string> words(std::string_view text) {
  std::vector<std::string> result;
  for (std::string_view w : split_list(text)) result.emplace_back(w);
  return result;
}

}  // namespace

TEST_CASE("every plugin that is supported has a reader, and only those") {
  for (int k = 0; k < kPluginKinds; ++k)
    for (const Plugin& p : Vocabulary::built_in().plugins(PluginKind(k))) {
      CAPTURE(p.name);
      if (PluginKind(k) == PluginKind::scene) continue;
      const bool has_reader = !std::holds_alternative<std::monostate>(p.reader);
      const bool supported = p.support != Support::refused;
      CHECK(has_reader == supported);
      CHECK((supported || p.parameters.empty()));
      CHECK((!supported || p.refused_parameters.empty()));
      // Who is refused wants to know why.
      CHECK((p.support != Support::refused || !p.note.empty()));
    }
}

TEST_CASE("names are unique and found again") {
  for (int k = 0; k < kPluginKinds; ++k) {
    const PluginKind kind = PluginKind(k);
    CHECK(kind_of_tag(tag_of(kind)) == kind);
    std::set<std::string> seen;
    for (const Plugin& p : Vocabulary::built_in().plugins(kind)) {
      CHECK(seen.insert(std::string(p.name)).second);
      CHECK(Vocabulary::built_in().find(kind, p.name) == &p);
      for (const std::string& alias : words(p.aliases))
        CHECK(Vocabulary::built_in().find(kind, alias) == &p);
      std::set<std::string> parameters;
      for (const std::span<const Parameter> list : {p.parameters, common_parameters(kind)})
        for (const Parameter& q : list) {
          CAPTURE(p.name);
          CAPTURE(q.name);
          // Sensors and lights may repeat a common parameter only by mistake.
          CHECK(parameters.insert(std::string(q.name)).second);
          CHECK(find_parameter(kind, p, q.name) == &q);
          CHECK(snake_case(q.name) == q.name);
          CHECK(snake_case(camel_case(q.name)) == q.name);
          for (const std::string& alias : words(q.aliases))
            CHECK(find_parameter(kind, p, alias) == &q);
        }
    }
  }
}

TEST_CASE("presets have the type of their parameter") {
  for (int k = 0; k < kPluginKinds; ++k)
    for (const Plugin& p : Vocabulary::built_in().plugins(PluginKind(k)))
      for (const std::span<const Parameter> list : {p.parameters, common_parameters(PluginKind(k))})
        for (const Parameter& q : list)
          for (std::string_view preset : {q.preset, q.preset_0x}) {
            CAPTURE(p.name);
            CAPTURE(q.name);
            if (preset.empty() || preset.starts_with('(')) continue;
            CHECK(!q.required);
            switch (q.type) {
              case ParameterType::boolean:
                CHECK(parse_boolean(preset));
                break;
              case ParameterType::integer:
                CHECK(parse_integer(preset));
                break;
              case ParameterType::number:
              case ParameterType::number_or_texture:
              case ParameterType::reflectance:
              case ParameterType::unbounded:
              case ParameterType::emission:
              case ParameterType::number_or_volume:
              case ParameterType::albedo:
              case ParameterType::coefficient:
                CHECK(parse_number(preset));
                break;
              case ParameterType::point:
                CHECK(parse_numbers(preset)->size() == 3);
                break;
              default:
                CHECK(!parse_number(preset));
            }
          }
}

TEST_CASE("all plugins of Mitsuba 3.9 and of 0.6 are known") {
  // The files in mitsuba/plugins of the Python package and in src/ of mitsuba-renderer/mitsuba.
  const std::pair<PluginKind, const char*> known[] = {
      {PluginKind::integrator,
       "aov depth direct moment path ptracer stokes volpath volpathmis bdpt mlt pssmlt erpt sppm "
       "ppm "
       "photonmapper vpl irrcache adaptive multichannel field ao motion volpath_simple prb "
       "prb_basic "
       "prb_projective prbvolpath direct_projective volprim_rf_basic"},
      {PluginKind::sensor,
       "perspective thinlens orthographic batch distant irradiancemeter radiancemeter fluencemeter "
       "perspective_rdist spherical telecentric"},
      {PluginKind::film, "hdrfilm specfilm ldrfilm mfilm tiledhdrfilm"},
      {PluginKind::rfilter, "box tent gaussian mitchell catmullrom lanczos"},
      {PluginKind::sampler,
       "independent stratified multijitter orthogonal ldsampler sobol halton hammersley"},
      {PluginKind::shape,
       "obj ply serialized rectangle sphere disk cylinder cube shapegroup instance bsplinecurve "
       "linearcurve ellipsoids ellipsoidsmesh sdfgrid merge blender hair heightfield deformable"},
      {PluginKind::bsdf,
       "diffuse conductor roughconductor dielectric thindielectric roughdielectric plastic "
       "roughplastic "
       "principled principledthin twosided mask blendbsdf bumpmap normalmap null circular hair "
       "measured "
       "measured_polarized polarizer pplastic retarder coating roughcoating difftrans hk irawan "
       "mixturebsdf phong ward roughdiffuse bump"},
      {PluginKind::texture,
       "bitmap checkerboard mesh_attribute volume blackbody d65 irregular rawconstant regular srgb "
       "uniform curvature gridtexture scale vertexcolors wireframe"},
      {PluginKind::emitter,
       "area constant directional directionalarea envmap point projector spot sunsky timed_sunsky "
       "collimated sky sun"},
      {PluginKind::medium, "homogeneous heterogeneous"},
      {PluginKind::phase,
       "isotropic hg rayleigh sggx tabphase blendphase kkay microflake mixturephase"},
      {PluginKind::volume, "constvolume gridvolume hgridvolume volcache"},
      {PluginKind::subsurface, "dipole singlescatter"},
  };
  for (const auto& [kind, names] : known)
    for (const std::string& name : words(names)) {
      CAPTURE(name);
      CHECK(Vocabulary::built_in().find(kind, name));
    }
  CHECK(!Vocabulary::built_in().find(PluginKind::bsdf, "difuse"));
  CHECK(did_you_mean("difuse", Vocabulary::built_in().names(PluginKind::bsdf)) ==
        " (did you mean \"diffuse\"?)");
}
