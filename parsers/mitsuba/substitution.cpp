#include "mitsuba/substitution.h"

#include <algorithm>
#include <cctype>

#include "mitsuba/text.h"

namespace duet {

namespace {

/// Attributes do not get longer than this by substitution.
constexpr size_t kLongestValue = 1 << 16;

}  // namespace

Substitution::Substitution(const std::vector<std::pair<std::string, std::string>>& defines) {
  for (const auto& [name, value] : defines)
    if (!find(name)) parameters_.push_back({name, value});
}

Substitution::Parameter* Substitution::find(std::string_view name) {
  for (Parameter& p : parameters_)
    if (p.name == name) return &p;
  return nullptr;
}

void Substitution::set_default(const std::string& name, const std::string& value) {
  Parameter* p = find(name);
  if (!p) p = &parameters_.emplace_back(Parameter{name, value});
  mark(*p);
}

std::optional<std::string> Substitution::expand(std::string_view text, const SourceLocation& where,
                                                Report& report) {
  std::string result;
  for (size_t i = 0; i < text.size();) {
    if (text[i] == '\\' && i + 1 < text.size() && text[i + 1] == '$') {
      result += '$';
      i += 2;
      continue;
    }
    if (text[i] != '$') {
      result += text[i++];
      continue;
    }
    const std::string_view rest = text.substr(i + 1);
    Parameter* meant = nullptr;
    for (Parameter& p : parameters_)
      if (!p.name.empty() && rest.starts_with(p.name) &&
          (!meant || p.name.size() > meant->name.size()))
        meant = &p;
    if (!meant) {
      const auto is_name = [](unsigned char c) { return std::isalnum(c) || c == '_'; };
      const auto end = std::find_if_not(rest.begin(), rest.end(), is_name);
      const std::string name(rest.begin(), end);
      std::vector<std::string> known;
      for (const Parameter& p : parameters_) known.push_back(p.name);
      report.error(where, "undefined parameter {}{}", in_quotes("$" + name),
                   did_you_mean(name, known));
      return std::nullopt;
    }
    mark(*meant);
    result += meant->value;
    i += 1 + meant->name.size();
    if (result.size() > kLongestValue) {
      report.error(where, "the value gets longer than {} bytes", kLongestValue);
      return std::nullopt;
    }
  }
  return result;
}

std::vector<std::pair<std::string, std::string>> Substitution::scene_parameters() const {
  std::vector<std::pair<std::string, std::string>> result(size_t(next_order_), {"", ""});
  for (const Parameter& p : parameters_)
    if (p.order >= 0) result[size_t(p.order)] = {p.name, p.value};
  return result;
}

}  // namespace duet
