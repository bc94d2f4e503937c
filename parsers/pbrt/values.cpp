#include "pbrt/values.h"

#include <algorithm>
#include <stdexcept>

#include "values/text.h"

namespace duet::pbrt {

namespace {

/// How many numbers or strings one value has; 0: any number of them.
int size_of(const Parameter& p) {
  switch (p.type) {
    case Type::point2:
    case Type::vector2:
      return 2;
    case Type::point3:
    case Type::vector3:
    case Type::normal:
    case Type::rgb:
    case Type::xyz:
      return 3;
    case Type::spectrum:
    case Type::blackbody:
      return 0;
    default:
      return 1;
  }
}

std::string names_of(Types types) {
  std::string text;
  for (unsigned i = 0; i <= unsigned(Type::texture); ++i)
    if (types & (1u << i)) text += (text.empty() ? "" : ", ") + std::string(type_name(Type(i)));
  const size_t last = text.rfind(", ");
  return last == text.npos ? text : text.replace(last, 2, " or ");
}

std::string wrong_type(const Parameter& p, Types types) {
  return fmt::format("parameter \"{}\" must be of type {}, not {}", p.name, names_of(types),
                     type_name(p.type));
}

/// Why the parameter is not of the type or count that is known of it; "" if it is.
std::string mismatch(const Parameter& p, const Spec& known) {
  if (!(known.types & of(p.type))) return wrong_type(p, known.types);
  const size_t values = p.numbers.size() + p.strings.size();
  const int size = p.type == Type::number && (known.types & of(Type::point2)) ? 2 : size_of(p);
  if (size > 1 && values % size_t(size) != 0)
    return fmt::format("parameter \"{}\" is of {} numbers each, but has {}", p.name, size, values);
  if (size > 0 && known.count > 0 && values != size_t(size) * size_t(known.count))
    return fmt::format("parameter \"{}\" has {} value{} instead of {}", p.name,
                       values / size_t(size), values == size_t(size) ? "" : "s", known.count);
  return {};
}

/// Whether there are values behind the one that is wanted, of which pbrt-v3 takes the first: those
/// of what may be a texture, unless they are names.
bool has_surplus(const Parameter& p, const Spec& known) {
  if (!(known.types & kTexture) || !(known.types & of(p.type)) || known.count != 1) return false;
  const size_t size = size_t(size_of(p));
  return p.strings.empty() && size > 0 && p.numbers.size() > size && p.numbers.size() % size == 0;
}

/// Whether the parameter says what holds without it.
bool is_preset(const Parameter& p, const Spec& known) {
  if (!p.strings.empty()) return p.strings.size() == 1 && p.strings.front() == known.preset;
  if (p.numbers.size() != 1) return false;
  if (known.types & kBoolean) return (p.numbers.front() != 0) == (known.preset == "true");
  return parse_number(known.preset) == p.numbers.front();
}

}  // namespace

Values::Values(Reader& reader, const Plugin& plugin, std::span<const Spec> specs,
               std::span<const Spec> more)
    : reader_(reader), plugin_(plugin), specs_(specs), more_(more) {
  for (const Parameter& p : plugin.parameters) check(p);
}

void Values::check(const Parameter& p) {
  Report& report = reader_.report();
  const Spec* known = nullptr;
  std::vector<std::string> names;
  for (const auto list : {specs_, more_})
    for (const Spec& s : list) {
      if (!has_version(s.versions, reader_.version())) continue;
      names.emplace_back(s.name);
      if (s.name == p.name) known = &s;
    }
  if (!known) {
    if (p.is_default) return;
    const std::string name = plugin_.name.empty() ? "" : fmt::format(" \"{}\"", plugin_.name);
    report.warning(p.where, "{}{} has no parameter {}{}; it is ignored", plugin_.directive, name,
                   in_quotes(p.name), did_you_mean(p.name, names));
    return;
  }
  const bool first_counts =
      reader_.version() == Version::v3 && plugin_.directive != "Shape" && has_surplus(p, *known);
  if (first_counts)
    report.warning(p.where, "parameter \"{}\" has surplus values: the first counts, as in pbrt-v3",
                   p.name);
  if (const std::string why = mismatch(p, *known); !first_counts && !why.empty()) {
    // pbrt-v3 looks for a name with a type and a count, and takes no notice of anything else.
    if (reader_.version() == Version::v3)
      report.warning(p.where, "{}; it is ignored, as pbrt-v3 does", why);
    else
      report.error(p.where, "{}", why);
    return;
  }
  if (known->status == Status::ignored && !is_preset(p, *known))
    report.warning(p.where, "parameter \"{}\" is ignored{}{}", p.name,
                   known->note.empty() ? "" : ": ", known->note);
  if (known->status == Status::refused) {
    report.error(p.where, "parameter \"{}\" is not supported{}{}", p.name,
                 known->note.empty() ? "" : ": ", known->note);
    return;
  }
  for (const Parameter*& other : given_) {
    if (other->name != p.name) continue;
    if (reader_.version() == Version::v3 || other->type == p.type) {
      report.warning(p.where, "parameter \"{}\" is given twice: the last one counts", p.name);
      other = &p;
    } else {
      report.error(p.where, "parameter \"{}\" is given twice, with two types", p.name);
    }
    return;
  }
  given_.push_back(&p);
}

void Values::drop_others_in_v3(std::string_view name, Types types) {
  const Parameter* p = given(name);
  if (reader_.version() == Version::v4 || !p || (types & of(p->type))) return;
  reader_.report().warning(p->where, "{}; it is ignored, as pbrt-v3 does", wrong_type(*p, types));
  std::erase(given_, p);
}

const Parameter* Values::given(std::string_view name) const {
  for (const Parameter* p : given_)
    if (p->name == name) return p;
  return nullptr;
}

const SourceLocation& Values::where(std::string_view name) const {
  const Parameter* p = given(name);
  return p ? p->where : plugin_.where;
}

const Spec& Values::spec(std::string_view name) const {
  for (const auto list : {specs_, more_})
    for (const Spec& s : list)
      if (s.name == name && has_version(s.versions, reader_.version())) return s;
  throw std::logic_error("no parameter " + std::string(name));
}

std::string_view Values::preset(std::string_view name) const {
  const Spec& s = spec(name);
  return reader_.version() == Version::v3 && !s.preset_v3.empty() ? s.preset_v3 : s.preset;
}

double Values::number(std::string_view name) {
  if (const Parameter* p = given(name)) return p->numbers.front();
  return parse_number(preset(name)).value_or(0);
}

double Values::positive(std::string_view name) {
  const double x = number(name);
  if (x > 0 || !has(name)) return x;
  reader_.report().error(where(name), "parameter \"{}\" must be greater than zero, not {}", name,
                         x);
  return std::max(1e-6, parse_number(preset(name)).value_or(1));
}

double Values::not_negative(std::string_view name) {
  const double x = number(name);
  if (x >= 0 || !has(name)) return x;
  reader_.report().error(where(name), "parameter \"{}\" must not be negative, but is {}", name, x);
  return std::max(0.0, parse_number(preset(name)).value_or(0));
}

bool Values::boolean(std::string_view name) {
  if (const Parameter* p = given(name)) return p->numbers.front() != 0;
  return preset(name) == "true";
}

std::string Values::string(std::string_view name) {
  if (const Parameter* p = given(name)) return p->strings.front();
  return std::string(preset(name));
}

std::array<double, 3> Values::point(std::string_view name) {
  const std::vector<double> all = numbers(name);
  return all.size() >= 3 ? std::array<double, 3>{all[0], all[1], all[2]} : std::array<double, 3>{};
}

std::vector<double> Values::numbers(std::string_view name) {
  if (const Parameter* p = given(name)) return p->numbers;
  return parse_numbers(preset(name)).value_or(std::vector<double>{});
}

std::string Values::file(std::string_view name) {
  const Parameter* p = given(name);
  return p ? reader_.file(p->strings.front(), p->where) : "";
}

Spectrum Values::color(std::string_view name, ColorMeaning meaning) {
  const Parameter* p = given(name);
  return p ? reader_.constant_color(*p, meaning) : preset_color(name);
}

Spectrum Values::preset_color(std::string_view name) const {
  const auto numbers = parse_numbers(preset(name)).value_or(std::vector<double>{0});
  if (numbers.size() == 3) return {float(numbers[0]), float(numbers[1]), float(numbers[2])};
  if (const auto metal = find_metal(preset(name), reader_.version())) return *metal;
  return Spectrum(float(numbers.empty() ? 0 : numbers[0]));
}

template <class Input>
const Input* Values::find_texture(const Parameter& p,
                                  const std::map<std::string, Input, std::less<>>& known,
                                  std::string_view of) {
  const std::string& name = p.strings.front();
  if (const auto found = known.find(name); found != known.end()) {
    reader_.count_texture();
    return &found->second;
  }
  // In v4 all textures of a file are made before anything that uses them.
  if (reader_.version() == Version::v4) {
    reader_.count_texture();
    return &reader_.await_texture<Input>(name, p.where, plugin_.directive == "Texture");
  }
  const std::string message =
      fmt::format("there is no texture {} of {}{}", in_quotes(name), of,
                  did_you_mean(name, reader_.report().names_for_hint(known)));
  if (reader_.version() == Version::v3)
    reader_.report().warning(p.where, "{}; it is ignored, as pbrt-v3 does", message);
  else
    reader_.report().error(p.where, "{}", message);
  return nullptr;
}

ColorInput Values::color_input(std::string_view name, ColorMeaning meaning) {
  const Parameter* p = given(name);
  if (!p || p->type != Type::texture) return color(name, meaning);
  const ColorInput* found = find_texture(*p, reader_.names().colors, "colours");
  return found ? *found : preset_color(name);
}

FloatInput Values::float_input(std::string_view name) {
  const Parameter* p = given(name);
  if (!p || p->type != Type::texture) return number(name);
  const FloatInput* found = find_texture(*p, reader_.names().numbers, "numbers");
  return found ? *found : parse_number(preset(name)).value_or(0);
}

double Values::index_of_refraction(std::string_view name) {
  const double eta = read_index(given(name), name);
  if (eta > 0) return eta;
  reader_.report().error(where(name), "an index of refraction must be greater than zero");
  return 1.5;
}

double Values::read_index(const Parameter* p, std::string_view name) {
  if (!p || p->type == Type::number) return number(name);
  if (p->type == Type::texture) {
    const FloatInput input = float_input(name);
    if (const double* constant = std::get_if<double>(&input)) return *constant;
    reader_.report().error(p->where, "an index of refraction that is a texture is not supported");
    return 1.5;
  }
  if (const auto glass = find_glass(p->strings.empty() ? "" : p->strings.front())) {
    reader_.approximate(p->where, fmt::format("{} without dispersion, by its index at 587.6 nm",
                                              p->strings.front()));
    return *glass;
  }
  const Spectrum color = reader_.constant_color(*p, ColorMeaning::unbounded);
  if (color.r == color.g && color.g == color.b) return double(color.r);
  reader_.approximate(p->where, "a refractive index without dispersion, by the spectrum's mean");
  return double(color.luminance());
}

}  // namespace duet::pbrt
