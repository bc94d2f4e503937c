#include "mitsuba/scene_writer.h"

#include <algorithm>

#include "mitsuba/plugins/integrators.h"
#include "mitsuba/writer.h"

namespace duet {

namespace {

/// "--" must not occur in a comment.
std::string commented(std::string_view text) {
  std::string out = "  ";
  for (const char c : text)
    if (c == '-' && out.back() == '-')
      out += " -";
    else
      out += c;
  return out += '\n';
}

}  // namespace

std::string SceneWriter::unique_id(const std::string& wanted, const std::string& otherwise) {
  const bool usable = wanted.find_first_of("$\\") == wanted.npos;
  return ids_.take(usable ? wanted : "", otherwise);
}

void SceneWriter::name_things() {
  const auto name = [&](const auto& things, std::vector<std::string>& ids, std::string_view kind) {
    for (const auto& thing : things)
      ids.push_back(unique_id(thing.label.text, fmt::format("{}{}", kind, ids.size())));
  };
  name(d_.textures, texture_ids_, "texture");
  name(d_.materials, material_ids_, "material");
  name(d_.media, medium_ids_, "medium");
  name(d_.groups, group_ids_, "group");
}

void SceneWriter::write() {
  name_things();
  integrator(d_.integrator);
  for (size_t i = 0; i < d_.media.size(); ++i) medium(d_.media[i], medium_ids_[i]);
  for (const SensorDescription& s : d_.sensors)
    if (s.kind != SensorKind::irradiancemeter) sensor(s);
  for (size_t i = 0; i < d_.textures.size(); ++i) texture(i);
  for (size_t i = 0; i < d_.materials.size(); ++i) material(d_.materials[i], material_ids_[i]);
  for (size_t i = 0; i < d_.groups.size(); ++i) {
    out_.open("shape", "shapegroup", {}, group_ids_[i]);
    for (const ShapeDescription& s : d_.groups[i].shapes) shape(s, "");
    out_.close();
  }
  for (const ShapeDescription& s : d_.shapes)
    shape(s, s.label.text.empty() ? "" : unique_id(s.label.text, s.label.text));
  bool has_environment = false;
  for (const LightDescription& l : d_.lights) {
    if (is_environment(l) && std::exchange(has_environment, true))
      lose("only the first of several environments is there");
    else
      light(l);
  }
}

void SceneWriter::integrator(const IntegratorDescription& i) {
  const bool layers = !i.aovs.layers.empty() || !i.image;
  if (layers) {
    std::string list;
    const auto& kinds = plugins::layer_kinds();
    bool in_frame = false;
    for (const AovDescription::Layer& l : i.aovs.layers) {
      in_frame |= l.in_frame;
      if (std::find(kinds.begin(), kinds.end(), l.kind) == kinds.end())
        lose(fmt::format("the layer \"{}\" is missing", l.name));
      else
        list += fmt::format("{}{}:{}", list.empty() ? "" : ", ", l.name, l.kind);
    }
    if (in_frame)
      lose("layers are in the coordinates of the world, with normals of either side of surfaces");
    out_.open("integrator", "aov");
    out_.string("aovs", list);
  }
  if (i.moments) out_.open("integrator", "moment");
  if (i.image)
    std::visit(
        [this](const auto& method) {
          out_.open("integrator", method.method_name());
          plugin("integrator", method);
          out_.close();
        },
        i.method);
  if (i.moments) out_.close();
  if (layers) out_.close();
}

void SceneWriter::view(const SensorDescription& s) {
  out_.open("sensor", s.name());
  plugin("sensor", s);
  for (const ShapeDescription& target : s.target_shape) shape(target, "", "target");
  for (const SensorDescription& part : s.parts) {
    view(part);
    out_.close();
  }
}

void SceneWriter::sensor(const SensorDescription& s) {
  view(s);
  if (s.medium) out_.reference({}, medium_id(*s.medium));
  out_.open("film", "hdrfilm");
  plugin("film", s.film);
  out_.close();
  const bool known = s.sampler.name == "independent" || s.sampler.name == "stratified" ||
                     s.sampler.name == "multijitter" || s.sampler.name == "orthogonal" ||
                     s.sampler.name == "ldsampler";
  if (!known) lose(fmt::format("the sampler \"{}\" is \"ldsampler\" instead", s.sampler.name));
  out_.open("sampler", known ? s.sampler.name : "ldsampler");
  fields(s.sampler);
  out_.close();
  out_.close();
}

void SceneWriter::light(const LightDescription& l) {
  // Not even Duet reads it from XML.
  if (std::holds_alternative<GoniometricLight>(l.model))
    return lose("the light \"goniometric\" does not exist in Mitsuba 3");
  LightDescription d = l;
  // The direction to the sun is one in the world.
  if (auto* sky = std::get_if<SkyLight>(&d.model)) sky->sun = l.to_world.turned(sky->sun);
  std::visit(
      [&](const auto& model) {
        out_.open("emitter", model.name());
        plugin("light", model);
      },
      d.model);
  if (!std::holds_alternative<ConstantLight>(l.model)) out_.transform("to_world", l.to_world);
  if (l.sampling_weight != 1) out_.number("sampling_weight", l.sampling_weight);
  if (l.medium) out_.reference({}, medium_id(*l.medium));
  if (l.portal) lose("an environment is seen in all directions, not through its portal alone");
  out_.close();
}

namespace {

/// Of a description in which nothing moves.
MitsubaXml write(const SceneDescription& description, std::vector<std::string> losses) {
  SceneWriter writer(description);
  writer.write();
  losses.insert(losses.end(), writer.losses().begin(), writer.losses().end());
  std::string comments;
  for (const std::string& loss : losses) comments += commented("Not in Mitsuba 3: " + loss);
  for (const Diagnostic& a : description.approximations)
    comments += commented("Approximated: " + a.message);
  std::string text = "<scene version=\"3.0.0\">\n";
  if (!comments.empty()) text += "  <!--\n" + comments + "  -->\n";
  return {text + writer.text() + "</scene>\n", std::move(losses)};
}

}  // namespace

MitsubaXml write_mitsuba_xml(const SceneDescription& description) {
  if (count_moving(description) > 0) {
    const double time = description.sensors.empty() ? 0 : description.sensors[0].shutter[0];
    return write(
        scene_at(description, time),
        {fmt::format("motion is missing: everything stands as it does at the time {}", time)});
  }
  return write(description, {});
}

}  // namespace duet
