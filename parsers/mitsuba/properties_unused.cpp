// What is said of properties that have the wrong type, or that no reader asked for.
#include "mitsuba/properties.h"
#include "values/text.h"

namespace duet {

namespace {

/// `an integer`, `a colour`: what a property is, in words.
std::string_view kind_of_value(const PropertyValue& value) {
  constexpr std::string_view names[] = {
      "nothing",           "a boolean",    "an integer", "a float",    "a string",
      "a point or vector", "a colour",     "a spectrum", "a spectrum", "a blackbody",
      "a transform",       "an animation", "a plugin",   "null"};
  static_assert(std::size(names) == std::variant_size_v<PropertyValue>);
  return names[value.index()];
}

/// The value as a default is written; "?" for what has no default.
std::string value_text(const PropertyValue& value) {
  if (const bool* truth = std::get_if<bool>(&value)) return *truth ? "true" : "false";
  if (const std::string* text = std::get_if<std::string>(&value)) return *text;
  if (const int64_t* whole = std::get_if<int64_t>(&value)) return fmt::format("{}", *whole);
  if (const double* number = std::get_if<double>(&value)) return fmt::format("{}", *number);
  return "?";
}

}  // namespace

void Properties::wrong_type(std::string_view name, const Property& property) {
  if (std::holds_alternative<Broken>(property.value)) return;
  const Parameter& p = parameter(name);
  report_.error(property.value_where, "{} is of type {}, not {}", expected(p), type_name(p.type),
                kind_of_value(property.value));
}

void Properties::finish() {
  for (const Entry& e : entries_)
    if (!e.used) report_unused(e);
}

bool Properties::report_misplaced(const Property& p) {
  const Node* const* node = std::get_if<const Node*>(&p.value);
  if (!node) return false;
  if (!may_contain(node_.kind, (*node)->kind)) {
    report_.error(p.where, "{} cannot stand in a <{}>", describe(**node), tag_of(node_.kind));
    return true;
  }
  if (!(*node)->plugin) return true;  // it has its own error
  if ((*node)->kind == PluginKind::texture || (*node)->kind == PluginKind::bsdf) return false;
  report_.error(p.where, "{} cannot be used by {}", describe(**node), describe(node_));
  return true;
}

void Properties::report_without_effect(const Parameter& known, const Property& p) {
  if (known.support == Support::inert || std::holds_alternative<Broken>(p.value)) return;
  if (known.support == Support::refused)
    return report_.error(p.where, "{} is refused: {}", expected(known), known.note);
  const bool ignored = known.support == Support::ignored;
  // Asking for what happens anyway needs no remark.
  if (ignored && value_text(p.value) == known.preset) return;
  report_.warning(p.where, "{} has no effect{}", expected(known),
                  ignored ? " on the linear image" : " here");
}

void Properties::report_unused(const Entry& e) {
  const Property& p = *e.property;
  if (report_misplaced(p)) return;
  if (e.parameter) return report_without_effect(*e.parameter, p);
  // <null/> says nothing on purpose; what is broken has its own error.
  if (p.name.empty() &&
      (std::holds_alternative<NullReference>(p.value) || std::holds_alternative<Broken>(p.value)))
    return;
  if (p.written.starts_with("metadata[") || p.written.starts_with("label["))
    return report_.warning(p.where, "annotations have no effect on the linear image");
  if (p.name.empty())
    return report_.warning(p.where, "{} is not used by {}", kind_of_value(p.value),
                           describe(node_));
  std::vector<std::string> names;
  if (!report_.is_full()) names = parameter_names(node_.kind, *node_.plugin);
  std::string near = nearest_name(p.name, names);
  if (!near.empty())
    near = fmt::format(" (did you mean \"{}\"?)", is_0x() ? camel_case(near) : near);
  report_.warning(p.where, "unused parameter {} of {}{}", in_quotes(p.written), describe(node_),
                  near);
}

}  // namespace duet
