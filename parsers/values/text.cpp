#include "values/text.h"

#include <cctype>
#include <charconv>
#include <cmath>
#include <limits>

namespace duet {

namespace {

constexpr std::string_view kSpace = " \t\r\n\f\v";

/// from_chars knows no plus sign.
std::string_view without_plus(std::string_view text) {
  if (text.size() > 1 && text[0] == '+' && text[1] != '-' && text[1] != '+') text.remove_prefix(1);
  return text;
}

bool is_lower(char c) {
  return c >= 'a' && c <= 'z';
}
bool is_upper(char c) {
  return c >= 'A' && c <= 'Z';
}
char lower(char c) {
  return is_upper(c) ? char(c - 'A' + 'a') : c;
}

}  // namespace

std::string_view trim(std::string_view text) {
  const size_t first = text.find_first_not_of(kSpace);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kSpace) - first + 1);
}

std::string to_lower(std::string_view text) {
  std::string s(text);
  for (char& c : s) c = lower(c);
  return s;
}

std::optional<double> parse_number(std::string_view text) {
  text = without_plus(trim(text));
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error == std::errc::result_out_of_range && end == text.data() + text.size() &&
      !text.empty()) {
    // Too small is zero, too large is not a number that can be used.
    const size_t exponent = text.find_first_of("eE");
    const bool tiny = exponent != std::string_view::npos && text.find('-', exponent) != text.npos;
    return tiny ? std::optional<double>(0.0) : std::nullopt;
  }
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  if (!(std::abs(value) <= double(std::numeric_limits<float>::max()))) return std::nullopt;
  return value;
}

std::optional<int64_t> parse_integer(std::string_view text) {
  text = without_plus(trim(text));
  int64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

std::optional<bool> parse_boolean(std::string_view text) {
  const std::string s = to_lower(trim(text));
  if (s == "true") return true;
  if (s == "false") return false;
  return std::nullopt;
}

std::vector<std::string_view> split_list(std::string_view text) {
  constexpr std::string_view separators = ", \t\r\n\f\v";
  std::vector<std::string_view> parts;
  size_t begin = text.find_first_not_of(separators);
  while (begin != std::string_view::npos) {
    const size_t end = text.find_first_of(separators, begin);
    parts.push_back(text.substr(begin, end - begin));
    begin = end == std::string_view::npos ? end : text.find_first_not_of(separators, end);
  }
  return parts;
}

std::optional<std::vector<double>> parse_numbers(std::string_view text) {
  std::vector<double> numbers;
  for (std::string_view part : split_list(text)) {
    const auto number = parse_number(part);
    if (!number) return std::nullopt;
    numbers.push_back(*number);
  }
  return numbers;
}

std::string snake_case(std::string_view name) {
  std::string s;
  for (size_t i = 0; i < name.size(); ++i) {
    if (i == 0 || !is_lower(name[i - 1]) || !is_upper(name[i])) {
      s += name[i];
      continue;
    }
    s += '_';
    for (; i < name.size() && is_upper(name[i]); ++i) s += lower(name[i]);
    --i;
  }
  return s;
}

std::string camel_case(std::string_view name) {
  std::string s;
  for (size_t i = 0; i < name.size(); ++i) {
    if (name[i] == '_' && i > 0 && i + 1 < name.size() && is_lower(name[i + 1]))
      s += char(name[++i] - 'a' + 'A');
    else
      s += name[i];
  }
  return s;
}

std::string in_quotes(std::string_view text) {
  constexpr size_t longest = 80;
  std::string s = "\"";
  for (char c : text.substr(0, longest)) s += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
  return s + (text.size() > longest ? "…\"" : "\"");
}

}  // namespace duet
