#include "evaluate/report/scene_json.h"

#include <nlohmann/json.hpp>

#include "evaluate/report/description_text.h"
#include "evaluate/report/scene_memory.h"
#include "evaluate/report/scene_parts.h"
#include "integrators/make_integrator.h"
#include "integrators/method_rules.h"
#include "scene/features.h"
#include "scene/mitsuba_differences.h"

namespace duet {

namespace {

using Json = nlohmann::ordered_json;

/// A list of what `describe` makes of each thing; empty, not null, if there are none.
template <class Things, class Describe>
Json list_of(const Things& things, Describe describe_one) {
  Json list = Json::array();
  for (const auto& thing : things) list.push_back(describe_one(thing));
  return list;
}

Json named(const std::vector<NamedText>& things) {
  return list_of(things, [](const NamedText& t) {
    return Json{{"name", t.name}, {"description", t.text}};
  });
}

Json remarks(const std::vector<Diagnostic>& diagnostics) {
  return list_of(diagnostics, [](const Diagnostic& d) {
    return Json{{"file", d.where.file ? *d.where.file : ""},
                {"line", d.where.line},
                {"column", d.where.column},
                {"message", d.message}};
  });
}

Json integrator(const IntegratorDescription& i) {
  return {{"name", integrator_name(i)},
          {"parameters", integrator_parameters(i)},
          {"layers", list_of(i.aovs.layers,
                             [](const auto& l) {
                               return Json{{"name", l.name}, {"kind", l.kind}};
                             })},
          {"moments", i.moments}};
}

Json sensor(const SensorDescription& s, const DescriptionText& text) {
  Json crop;
  if (const auto& c = s.film.crop)
    crop = {{"x", c->x}, {"y", c->y}, {"width", c->width}, {"height", c->height}};
  return {{"type", sensor_name(s.kind)},
          {"name", s.label.text},
          {"description", text.sensor(s)},
          {"film", text.film(s.film)},
          {"width", s.film.width},
          {"height", s.film.height},
          {"crop", crop},
          {"sampler", s.sampler.name},
          {"spp", s.sampler.sample_count},
          {"seed", s.sampler.seed}};
}

Json shapes(const SceneDescription& scene, const SceneFeatures& f, const SceneParts& parts,
            const DescriptionText& text) {
  Json bounds;
  if (!f.bounds.empty())
    bounds = {{"lower", {f.bounds.lower.x, f.bounds.lower.y, f.bounds.lower.z}},
              {"upper", {f.bounds.upper.x, f.bounds.upper.y, f.bounds.upper.z}}};
  Json kinds = Json::object();
  for (const auto& [kind, count] : parts.shape_kinds) kinds[kind] = count;
  return {{"count", scene.shapes.size()},
          {"kinds", kinds},
          {"triangles", f.triangles},
          {"triangles_in_all_copies", f.placed_triangles},
          {"curve_segments", f.curve_segments},
          {"bounds", bounds},
          {"list", list_of(scene.shapes, [&](const auto& s) { return text.shape(s); })}};
}

Json method(const SceneDescription& scene, const std::string& name) {
  const std::string obstacle = method_obstacle(scene, name);
  return {{"name", name},
          {"renders", obstacle.empty()},
          {"obstacle", obstacle.empty() ? Json() : Json(obstacle)}};
}

/// Bytes.
Json memory(const SceneMemory& m) {
  return {{"total", uint64_t(m.total())},
          {"description", uint64_t(m.description)},
          {"geometry", uint64_t(m.geometry)},
          {"images", uint64_t(m.images)},
          {"film", uint64_t(m.film)}};
}

Json rules(const MethodRules& r) {
  return {{"has_lights", r.has_lights}, {"needs_light_walks", r.needs_light_subpaths},
          {"may_merge", r.may_merge},   {"far_lights_only", r.far_lights_only},
          {"has_media", r.has_media},   {"has_heterogeneous_media", r.has_heterogeneous_media},
          {"description", describe(r)}};
}

}  // namespace

nlohmann::ordered_json scene_json(const std::string& file, const std::string& name,
                                  const LoadedScene& loaded) {
  const SceneDescription& scene = loaded.description;
  const DescriptionText text(scene);
  const SceneFeatures features = scene_features(scene);
  const SceneParts parts = scene_parts(scene);
  Json parameters = Json::object();
  for (const auto& [parameter, value] : loaded.parameters) parameters[parameter] = value;

  Json j;
  j["file"] = file;
  j["name"] = name;
  j["version"] = loaded.version;
  j["parameters"] = parameters;
  j["integrator"] = integrator(scene.integrator);
  j["sensors"] = list_of(scene.sensors, [&](const auto& s) { return sensor(s, text); });
  j["shapes"] = shapes(scene, features, parts, text);
  j["shape_groups"] = list_of(scene.groups, [&](const ShapeGroupDescription& g) {
    return Json{{"name", g.label.text},
                {"shapes", list_of(g.shapes, [&](const auto& s) { return text.shape(s); })}};
  });
  j["bsdfs"] = named(parts.bsdfs);
  j["textures"] = list_of(scene.textures, [&](const auto& t) { return text.texture(t); });
  j["media"] = named(parts.media);
  j["lights"] = parts.lights;
  j["modelled"] = describe(features);
  j["rules"] = rules(method_rules(features));
  j["methods"] =
      list_of(integrator_names(), [&](const IntegratorName& n) { return method(scene, n.name); });
  j["memory"] = memory(estimate_scene_memory(scene));
  j["approximated"] = remarks(scene.approximations);
  j["differs_from_mitsuba"] =
      list_of(mitsuba_differences(scene, features), [](const MitsubaDifference* d) {
        return Json{{"id", d->id}, {"mitsuba", d->mitsuba}, {"measured", d->measured}};
      });
  j["warnings"] = remarks(loaded.warnings);
  return j;
}

std::string json_text(const nlohmann::ordered_json& value) {
  return value.dump(2, ' ', false, Json::error_handler_t::replace);
}

}  // namespace duet
