#include "pbrt/parameter.h"

#include <cmath>
#include <utility>

#include "values/text.h"

namespace duet::pbrt {

namespace {

constexpr std::pair<std::string_view, Type> kTypes[] = {
    {"integer", Type::integer},   {"float", Type::number},    {"bool", Type::boolean},
    {"string", Type::string},     {"point2", Type::point2},   {"vector2", Type::vector2},
    {"point3", Type::point3},     {"vector3", Type::vector3}, {"normal", Type::normal},
    {"rgb", Type::rgb},           {"xyz", Type::xyz},         {"blackbody", Type::blackbody},
    {"spectrum", Type::spectrum}, {"texture", Type::texture}, {"point", Type::point3},
    {"vector", Type::vector3},    {"color", Type::rgb},       {"normal3", Type::normal},
    {"int", Type::integer},
};

/// The values of a parameter in the file: all strings, or all numbers.
class ValueReader {
 public:
  ValueReader(Lexer& in, Parameter& parameter) : in_(in), p_(parameter) {}

  void read() {
    if (in_.peek() != Kind::open) {
      one();
      return;
    }
    const SourceLocation open = in_.where();
    in_.take_bracket();
    while (in_.peek() != Kind::close) {
      if (in_.peek() == Kind::end || in_.peek() == Kind::open)
        throw SyntaxError{open, "a list without its end"};
      one();
    }
    in_.take_bracket();
  }

 private:
  void one() {
    const SourceLocation where = in_.where();
    switch (in_.peek()) {
      case Kind::number:
        in_.take_numbers(p_.numbers);
        break;
      case Kind::string:
        if (p_.type == Type::boolean)
          boolean(in_.take_string(), where);
        else
          p_.strings.push_back(in_.take_string());
        break;
      case Kind::word: {
        const std::string word = in_.take_word();
        if (p_.type != Type::boolean)
          throw SyntaxError{
              where, fmt::format("a value of \"{}\" cannot be {}", p_.name, in_quotes(word))};
        boolean(word, where);
        break;
      }
      default:
        throw SyntaxError{where, fmt::format("parameter \"{}\" has no value", p_.name)};
    }
  }
  void boolean(const std::string& text, const SourceLocation& where) {
    if (text != "true" && text != "false")
      throw SyntaxError{where, fmt::format("{} is neither true nor false", in_quotes(text))};
    p_.numbers.push_back(text == "true");
  }

  Lexer& in_;
  Parameter& p_;
};

/// Whether the values are of the kind that the type has; a message if not.
std::string mismatch(const Parameter& p) {
  const bool text = p.type == Type::string || p.type == Type::texture;
  if (p.numbers.empty() && p.strings.empty())
    return fmt::format("parameter \"{}\" has no value", p.name);
  if (!p.numbers.empty() && !p.strings.empty())
    return fmt::format("parameter \"{}\" has both numbers and strings", p.name);
  if (text && p.strings.empty())
    return fmt::format("parameter \"{}\" is a {}: its value stands in quotes", p.name,
                       type_name(p.type));
  if (!text && p.type != Type::spectrum && !p.strings.empty())
    return fmt::format("parameter \"{}\" is a {}: its value is a number, not {}", p.name,
                       type_name(p.type), in_quotes(p.strings.front()));
  if (p.type == Type::integer)
    for (const double x : p.numbers)
      if (x != std::floor(x) || std::abs(x) > 2147483647.0)
        return fmt::format("{} is not an integer of 32 bits", x);
  return {};
}

Parameter read_parameter(Lexer& in, uint8_t color_space) {
  Parameter p;
  p.where = in.where();
  p.color_space = color_space;
  const std::string declared = in.take_string();
  const std::string_view text = trim(declared);
  const size_t gap = text.find_first_of(" \t");
  const std::string_view type = text.substr(0, gap);
  p.name = gap == text.npos ? "" : std::string(trim(text.substr(gap)));
  const auto found = find_type(type);
  if (found) p.type = *found;
  if (!found || p.name.empty()) {
    // The value is skipped, so that what follows is understood.
    Parameter ignored;
    ignored.type = Type::string;
    std::string message =
        fmt::format("{} is not \"type name\" of a parameter", in_quotes(declared));
    if (!found && gap != text.npos) {
      std::vector<std::string> known;
      for (const auto& [name, value] : kTypes) known.emplace_back(name);
      message = fmt::format("{} is not a type{}", in_quotes(type),
                            did_you_mean(std::string(type), known));
    }
    const Kind next = in.peek();
    if (next == Kind::open || next == Kind::number || next == Kind::string)
      ValueReader(in, ignored).read();
    throw SyntaxError{p.where, message};
  }
  ValueReader(in, p).read();
  return p;
}

}  // namespace

const char* type_name(Type type) {
  for (const auto& [name, value] : kTypes)
    if (value == type) return name.data();
  return "";
}

std::optional<Type> find_type(std::string_view name) {
  for (const auto& [known, type] : kTypes)
    if (known == name) return type;
  return std::nullopt;
}

const Parameter* Plugin::find(std::string_view parameter) const {
  for (const Parameter& p : parameters)
    if (p.name == parameter) return &p;
  return nullptr;
}

Parameter read_option(Lexer& in, std::span<const Spec> known) {
  Parameter p;
  p.where = in.where();
  const std::string declared = in.take_string();
  const std::string_view text = trim(declared);
  const size_t gap = text.find_first_of(" \t");
  for (const char c : gap == text.npos ? text : trim(text.substr(gap)))
    if (c != '-' && c != '_') p.name += c;
  p.name = to_lower(p.name);
  std::optional<Type> type;
  if (gap != text.npos) type = find_type(text.substr(0, gap));
  for (const Spec& s : known)
    for (unsigned i = 0; s.name == p.name && !type && i <= unsigned(Type::texture); ++i)
      if (s.types & (1u << i)) type = Type(i);
  // Of what there is not, the value is read, so that what follows is understood.
  const Kind value = in.peek();
  p.type = type.value_or(value == Kind::word     ? Type::boolean
                         : value == Kind::string ? Type::string
                                                 : Type::number);
  ValueReader(in, p).read();
  if (const std::string why = mismatch(p); !why.empty()) throw SyntaxError{p.where, why};
  return p;
}

std::vector<Parameter> read_parameters(Lexer& in, uint8_t color_space, Report& report) {
  std::vector<Parameter> result;
  while (in.peek() == Kind::string) {
    try {
      Parameter p = read_parameter(in, color_space);
      if (const std::string why = mismatch(p); !why.empty())
        report.error(p.where, "{}", why);
      else
        result.push_back(std::move(p));
    } catch (const SyntaxError& e) {
      report.error(e.where, "{}", e.message);
      // What is left of a list.
      std::vector<double> numbers;
      try {
        for (Kind k = in.peek(); k == Kind::number || k == Kind::close; k = in.peek())
          k == Kind::number ? in.take_numbers(numbers) : in.take_bracket();
      } catch (const SyntaxError&) {
        in.skip_to_next_line();
      }
    }
  }
  return result;
}

}  // namespace duet::pbrt
