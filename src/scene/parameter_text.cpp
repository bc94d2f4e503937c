#include "scene/parameter_text.h"

#include <iterator>

namespace duet {

std::string_view type_name(ParameterType type) {
  constexpr std::string_view names[] = {"boolean",
                                        "integer",
                                        "float",
                                        "string",
                                        "point or vector",
                                        "transform",
                                        "file name",
                                        "float or name of a material",
                                        "texture",
                                        "float or texture",
                                        "colour or texture",
                                        "colour or texture",
                                        "colour or texture",
                                        "volume",
                                        "float or volume",
                                        "colour or volume",
                                        "colour or volume"};
  static_assert(std::size(names) == size_t(ParameterType::coefficient) + 1);
  return names[size_t(type)];
}

std::optional<std::string_view> broken_rule(NumberRange range, double value) {
  const auto rule = [](bool good, std::string_view words) {
    return good ? std::nullopt : std::optional(words);
  };
  switch (range) {
    case NumberRange::any:
      return std::nullopt;
    case NumberRange::positive:
      return rule(value > 0, "positive");
    case NumberRange::not_negative:
      return rule(value >= 0, "at least 0");
    case NumberRange::size:
      return rule(value >= 1 && value <= 65536, "from 1 to 65536");
    case NumberRange::depth:
      return rule(value >= -1, "-1 or more");
    case NumberRange::degrees:
      return rule(value > 0 && value < 180, "between 0 and 180");
    case NumberRange::fraction:
      return rule(value >= 0 && value <= 1, "from 0 to 1");
    case NumberRange::probability:
      return rule(value > 0 && value <= 1, "above 0 and at most 1");
  }
  return std::nullopt;
}

bool has_word(std::string_view words, std::string_view name) {
  while (!words.empty()) {
    const size_t end = words.find(' ');
    if (words.substr(0, end) == name) return true;
    words = end == std::string_view::npos ? std::string_view() : words.substr(end + 1);
  }
  return false;
}

}  // namespace duet
