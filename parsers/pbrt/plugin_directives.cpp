// Directives that set the state, and those that name a plugin.
#include "pbrt/directives.h"
#include "pbrt/spectra.h"
#include "pbrt/values.h"
#include "values/text.h"

namespace duet::pbrt {

void Directives::reverse_orientation(Lexer&, const Plugin&) {
  state().reverse_orientation = !state().reverse_orientation;
}

void Directives::attribute(Lexer& in, const Plugin& d) {
  const std::string target = take_string(in, d);
  std::vector<Parameter> parameters = read_parameters(in, state().color_space, report());
  for (Parameter& p : parameters) p.is_default = true;
  const std::vector<std::string> targets{"shape", "light", "material", "medium", "texture"};
  if (std::find(targets.begin(), targets.end(), target) == targets.end()) {
    report().error(d.where, "there are no defaults for {}{}", in_quotes(target),
                   did_you_mean(target, targets));
    return;
  }
  auto changed = std::make_shared<Defaults>(state().defaults ? *state().defaults : Defaults{});
  std::vector<Parameter>& list = (*changed)[target];
  for (Parameter& p : list) {
    bool replaced = false;
    for (const Parameter& q : parameters) replaced |= q.name == p.name;
    if (!replaced) parameters.push_back(std::move(p));
  }
  list = std::move(parameters);
  state().defaults = std::move(changed);
}

void Directives::color_space(Lexer& in, const Plugin& d) {
  const std::string name = take_string(in, d);
  if (const auto found = find_color_space(name)) {
    state().color_space = *found;
    return;
  }
  std::vector<std::string> names;
  for (const ColorSpace& c : color_spaces()) names.emplace_back(c.name);
  report().warning(d.where, "there is no colour space {}{}; the one before holds, as in pbrt",
                   in_quotes(name), did_you_mean(name, names));
}

void Directives::option(Lexer& in, const Plugin& d) {
  using enum Status;
  static constexpr Spec kOptions[] = {
      {"disablepixeljitter", kBoolean, "false", "", 1, ignored},
      {"disabletexturefiltering", kBoolean, "false", "", 1, inert},
      {"disablewavelengthjitter", kBoolean, "false", "", 1, inert},
      {"displacementedgescale", kNumber, "1", ""},
      {"forcediffuse", kBoolean, "false", "", 1, ignored},
      {"msereferenceimage", kString, "", "", 1, inert},
      {"msereferenceout", kString, "", "", 1, inert},
      {"pixelstats", kBoolean, "false", "", 1, inert},
      {"rendercoordsys", kString, "cameraworld", "", 1, inert},
      {"seed", kInteger, "0", "", 1, inert},
      {"wavefront", kBoolean, "false", "", 1, inert},
  };
  Plugin plugin = d;
  while (in.peek() == Kind::string) plugin.parameters.push_back(read_option(in, kOptions));
  Values v(reader_, plugin, kOptions);
  if (v.has("displacementedgescale"))
    reader_.displacement_edge_scale = v.positive("displacementedgescale");
}

namespace {

/// Keeps what a directive says of which there is one.
void keep(Report& report, std::optional<Plugin>& kept, Plugin given) {
  if (kept) report.warning(given.where, "{} is given again: the last one counts", given.directive);
  kept = std::move(given);
}

}  // namespace

void Directives::camera(Lexer& in, const Plugin& d) {
  Plugin plugin = d;
  take_plugin(in, plugin);
  std::array<Matrix4, 2> to_world;
  for (size_t i = 0; i < 2; ++i) {
    const auto inverse = state().ctm[i].inverse();
    if (!inverse) {
      report().error(d.where, "the camera's transform cannot be inverted");
      return;
    }
    to_world[i] = *inverse;
  }
  coordinate_systems_["camera"] = to_world;
  reader_.camera_state = state();
  reader_.camera_state.ctm = to_world;
  keep(report(), reader_.camera, std::move(plugin));
}

void Directives::film(Lexer& in, const Plugin& d) {
  Plugin plugin = d;
  take_plugin(in, plugin);
  reader_.film_color_space = state().color_space;
  keep(report(), reader_.film, std::move(plugin));
}

void Directives::filter(Lexer& in, const Plugin& d) {
  Plugin plugin = d;
  take_plugin(in, plugin);
  keep(report(), reader_.filter, std::move(plugin));
}

void Directives::sampler(Lexer& in, const Plugin& d) {
  Plugin plugin = d;
  take_plugin(in, plugin);
  keep(report(), reader_.sampler, std::move(plugin));
}

void Directives::integrator(Lexer& in, const Plugin& d) {
  Plugin plugin = d;
  take_plugin(in, plugin);
  keep(report(), reader_.integrator, std::move(plugin));
}

void Directives::accelerator(Lexer& in, const Plugin& d) {
  Plugin plugin = d;
  take_plugin(in, plugin);
  check_accelerator(reader_, plugin);
}

void Directives::of_version_2(Lexer& in, const Plugin& d) {
  Plugin plugin = d;
  take_plugin(in, plugin);
  if (plugin.name != "sampler")
    report().warning(d.where, "{} \"{}\" is pbrt-v2's; it is ignored", d.directive, plugin.name);
}

void Directives::shape(Lexer& in, const Plugin& d) {
  Plugin plugin = d;
  take_plugin(in, plugin, "shape");
  read_shape(reader_, std::move(plugin));
}

void Directives::area_light(Lexer& in, const Plugin& d) {
  auto plugin = std::make_shared<Plugin>(d);
  take_plugin(in, *plugin, "light");
  state().area_light = std::move(plugin);
}

void Directives::light(Lexer& in, const Plugin& d) {
  Plugin plugin = d;
  take_plugin(in, plugin, "light");
  read_light(reader_, plugin);
}

void Directives::material(Lexer& in, const Plugin& d) {
  Plugin plugin = d;
  take_plugin(in, plugin, "material");
  const auto made = read_material(reader_, plugin);
  if (!made) return;
  state().material = *made;
  if (reader_.version() == Version::v3)
    state().material_plugin = std::make_shared<const Plugin>(std::move(plugin));
}

namespace {

/// Takes the parameter "type" out of the others: it says which plugin it is.
std::string take_type(Plugin& plugin, Report& report) {
  for (size_t i = 0; i < plugin.parameters.size(); ++i) {
    const Parameter& p = plugin.parameters[i];
    if (p.name != "type" || p.type != Type::string) continue;
    std::string type = p.strings.front();
    plugin.parameters.erase(plugin.parameters.begin() + std::ptrdiff_t(i));
    return type;
  }
  report.error(plugin.where, "{} {} has no \"string type\"", plugin.directive,
               in_quotes(plugin.name));
  return "";
}

}  // namespace

void Directives::make_named_material(Lexer& in, const Plugin& d) {
  Plugin plugin = d;
  take_plugin(in, plugin, "material");
  const std::string name = plugin.name;
  plugin.name = take_type(plugin, report());
  if (plugin.name.empty() && plugin.parameters.empty()) return;
  const auto made = read_material(reader_, plugin);
  if (!made) return;
  reader_.define_material(name, *made, d.where);
  if (reader_.version() == Version::v3)
    reader_.change_names().material_plugins[name] =
        std::make_shared<const Plugin>(std::move(plugin));
}

void Directives::use_material(const std::string& name, const SourceLocation& where) {
  state().material = reader_.named_material(name, where);
  const auto& plugins = reader_.names().material_plugins;
  const auto found = plugins.find(name);
  state().material_plugin = found == plugins.end() ? nullptr : found->second;
}

void Directives::named_material(Lexer& in, const Plugin& d) {
  const std::string name = take_string(in, d);
  if (reader_.version() == Version::v3 && !reader_.names().materials.contains(name))
    report().warning(d.where, "there is no material {} here; the one before holds, as in pbrt-v3{}",
                     in_quotes(name),
                     did_you_mean(name, report().names_for_hint(reader_.names().materials)));
  else
    use_material(name, d.where);
}

void Directives::texture(Lexer& in, const Plugin& d) {
  Plugin plugin = d;
  const std::string name = take_string(in, d), kind = take_string(in, d);
  take_plugin(in, plugin, "texture");
  read_texture(reader_, plugin, name, kind);
}

void Directives::make_named_medium(Lexer& in, const Plugin& d) {
  Plugin plugin = d;
  take_plugin(in, plugin, "medium");
  read_medium(reader_, plugin);
}

void Directives::medium_interface(Lexer& in, const Plugin& d) {
  const std::string inside = take_string(in, d);
  const std::string outside = in.peek() == Kind::string ? in.take_string() : inside;
  const auto medium = [&](const std::string& name) -> std::optional<MediumId> {
    if (name.empty()) return std::nullopt;
    return reader_.named_medium(name, d.where);
  };
  state().inside = medium(inside);
  state().outside = medium(outside);
}

}  // namespace duet::pbrt
