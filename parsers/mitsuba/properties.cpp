#include "mitsuba/properties.h"

#include <cassert>

#include "values/text.h"

namespace duet {

namespace {

/// Children that are not parameters have a meaning by their kind alone, except textures and
/// volumes.
bool is_parameter_kind(const Property& p) {
  const Node* const* node = std::get_if<const Node*>(&p.value);
  return !node || (*node)->kind == PluginKind::texture || (*node)->kind == PluginKind::volume;
}

}  // namespace

Properties::Properties(const Node& node, Report& report) : node_(node), report_(report) {
  entries_.reserve(node.properties.size());
  for (const Property& p : node.properties) {
    const Parameter* parameter =
        p.name.empty() ? nullptr : find_parameter(node.kind, *node.plugin, p.name);
    if (parameter && !is_parameter_kind(p)) parameter = nullptr;
    Entry* first = nullptr;
    if (parameter)
      for (Entry& e : entries_)
        if (e.parameter == parameter) first = &e;
    if (first && is_0x() && first->property->written == p.written) {
      report_.warning(p.where, "the parameter {} is given again, and the last value holds",
                      in_quotes(p.written));
      first->property = &p;
      continue;
    }
    if (first) {
      const int line = first->property->where.line;
      report_.error(p.where, "the parameter {} is given twice{}", in_quotes(p.written),
                    line > 0 ? fmt::format(", first in line {}", line) : "");
      continue;
    }
    entries_.push_back({&p, parameter});
  }
}

bool Properties::knows(std::string_view name) const {
  return find_parameter(node_.kind, *node_.plugin, name) != nullptr;
}

const Parameter& Properties::parameter(std::string_view name) const {
  const Parameter* p = find_parameter(node_.kind, *node_.plugin, name);
  assert(p && "the vocabulary has no such parameter");
  return *p;
}

const Properties::Entry* Properties::entry(std::string_view name) const {
  for (const Entry& e : entries_)
    if (e.parameter && e.parameter->name == name) return &e;
  return nullptr;
}

bool Properties::has(std::string_view name) const {
  return entry(name) != nullptr;
}

const Property* Properties::find(std::string_view name) {
  const Parameter& p = parameter(name);
  for (Entry& e : entries_)
    if (e.parameter == &p) {
      e.used = true;
      return e.property;
    }
  if (p.required)
    report_.error(node_.where, "{} needs the parameter \"{}\"", describe(node_),
                  is_0x() ? camel_case(name) : std::string(name));
  return nullptr;
}

const Property* Properties::find_own(std::string_view written) {
  for (Entry& e : entries_)
    if (!e.parameter && e.property->written == written) {
      e.used = true;
      return e.property;
    }
  return nullptr;
}

std::string_view Properties::preset(std::string_view name) const {
  const Parameter& p = parameter(name);
  return is_0x() && !p.preset_0x.empty() ? p.preset_0x : p.preset;
}

const SourceLocation& Properties::where(std::string_view name) const {
  const Entry* e = entry(name);
  return e ? e->property->value_where : node_.where;
}

std::string Properties::expected(const Parameter& p) const {
  return fmt::format("the parameter \"{}\" of {}",
                     is_0x() ? camel_case(p.name) : std::string(p.name), describe(node_));
}

bool Properties::in_range(std::string_view name, double value) {
  const Parameter& p = parameter(name);
  const auto rule = broken_rule(p.range, value);
  if (rule) error(name, "{} must be {}, not {}", expected(p), *rule, value);
  return !rule;
}

bool Properties::boolean(std::string_view name) {
  const bool* given = value<bool>(name);
  return given ? *given : preset(name) == "true";
}

int Properties::integer(std::string_view name) {
  constexpr int64_t largest = 1 << 30;
  const int otherwise = int(parse_integer(preset(name)).value_or(0));
  const Property* p = find(name);
  if (!p) return otherwise;
  const int64_t* value = std::get_if<int64_t>(&p->value);
  // Mitsuba's manuals themselves write <float> for some counts.
  const double* real = std::get_if<double>(&p->value);
  if (!value && !(real && *real == double(int64_t(*real)) && std::abs(*real) < double(largest))) {
    wrong_type(name, *p);
    return otherwise;
  }
  const int64_t number = value ? *value : int64_t(*real);
  if (!in_range(name, double(number))) return otherwise;
  // Sentinels like 2³² − 1 stand for "no limit" in counts.
  return int(std::min(number, largest));
}

std::optional<double> Properties::optional_number(std::string_view name) {
  const Property* p = find(name);
  if (!p) return std::nullopt;
  std::optional<double> value;
  if (const double* real = std::get_if<double>(&p->value)) value = *real;
  if (const int64_t* whole = std::get_if<int64_t>(&p->value)) value = double(*whole);
  if (!value) {
    wrong_type(name, *p);
    return std::nullopt;
  }
  return in_range(name, *value) ? value : std::nullopt;
}

double Properties::number(std::string_view name) {
  return optional_number(name).value_or(parse_number(preset(name)).value_or(0));
}

std::string Properties::string(std::string_view name) {
  const std::string* given = value<std::string>(name);
  return given ? *given : std::string(preset(name));
}

std::vector<double> Properties::numbers(std::string_view name) {
  if (!has(name)) return find(name), std::vector<double>();
  const std::string text = string(name);
  auto numbers = parse_numbers(text);
  if (!numbers) error(name, "{} is not a list of numbers", in_quotes(text));
  return numbers.value_or(std::vector<double>());
}

Triple Properties::triple(std::string_view name) {
  if (const Triple* given = value<Triple>(name)) return *given;
  const auto numbers = parse_numbers(preset(name));
  return numbers && numbers->size() == 3 ? Triple{(*numbers)[0], (*numbers)[1], (*numbers)[2]}
                                         : Triple{};
}

void Properties::only_one(std::string_view name, std::string_view other, std::string_view at) {
  if (has(name) && has(other))
    error(at.empty() ? name : at, "either \"{}\" or \"{}\" can be given", name, other);
}

Matrix4 Properties::transform(std::string_view name) {
  Motion motion;
  const Matrix4 value = transform(name, motion);
  if (!motion.empty())
    error(name,
          "{} cannot be an animation: what moves are shapes, their instances, sensors, and "
          "lights other than the sky",
          expected(parameter(name)));
  return value;
}

Matrix4 Properties::transform(std::string_view name, Motion& motion) {
  if (const Property* p = find(name)) {
    if (const Matrix4* value = std::get_if<Matrix4>(&p->value)) return *value;
    if (const Motion* value = std::get_if<Motion>(&p->value))
      motion = *value;
    else
      wrong_type(name, *p);
  }
  return {};
}

size_t Properties::choice(std::string_view name, std::span<const std::string_view> words) {
  const auto simplified = [](std::string_view word) {
    std::string s = to_lower(trim(word));
    std::erase(s, '_');
    return s;
  };
  const std::string value = string(name);
  for (size_t i = 0; i < words.size(); ++i)
    if (simplified(words[i]) == simplified(value)) return i;
  const std::vector<std::string> known(words.begin(), words.end());
  error(name, "{} cannot be {}{}; it is one of {}", expected(parameter(name)), in_quotes(value),
        did_you_mean(value, known), fmt::join(known, ", "));
  return 0;
}

std::vector<Properties::Child> Properties::children(PluginKind kind) {
  std::vector<Child> result;
  for (Entry& e : entries_)
    if (const Node* const* node = std::get_if<const Node*>(&e.property->value))
      if (!e.parameter && (*node)->kind == kind) {
        e.used = true;
        result.push_back({*node, e.property});
      }
  return result;
}

const Node* Properties::child(PluginKind kind) {
  const std::vector<Child> all = children(kind);
  for (size_t i = 1; i < all.size(); ++i)
    report_.error(all[i].property->where, "{} can have only one {}", describe(node_), tag_of(kind));
  return all.empty() ? nullptr : all[0].node;
}

}  // namespace duet
