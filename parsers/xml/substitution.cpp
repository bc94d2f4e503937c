#include "xml/substitution.h"

#include <algorithm>
#include <cctype>

#include "values/text.h"

namespace duet {

namespace {

/// Attributes do not get longer than this by substitution.
constexpr size_t kLongestValue = 1 << 16;

}  // namespace

Substitution::Substitution(const std::vector<std::pair<std::string, std::string>>& defines) {
  for (const auto& [name, value] : defines)
    if (!name.empty()) parameters_.try_emplace(name, Parameter{{value, name + "=" + value}});
}

void Substitution::set_default(const std::string& name, const Expansion& value) {
  if (!name.empty()) mark(parameters_.try_emplace(name, Parameter{value}).first->second);
}

Substitution::Parameters::iterator Substitution::longest_prefix(std::string_view text) {
  // Prefixes of the text are sorted by length and lie before it.
  for (;;) {
    auto next = parameters_.upper_bound(text);
    if (next == parameters_.begin()) return parameters_.end();
    --next;
    if (text.starts_with(next->first)) return next;
    // What lies between and is a prefix of the text is one of what both have in common, too.
    const auto [in_text, in_name] =
        std::mismatch(text.begin(), text.end(), next->first.begin(), next->first.end());
    text = text.substr(0, size_t(in_text - text.begin()));
  }
}

std::optional<Expansion> Substitution::expand(std::string_view text, const SourceLocation& where,
                                              Report& report) {
  std::string result, define;
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
    const auto meant = longest_prefix(rest);
    if (meant == parameters_.end()) {
      const auto is_name = [](unsigned char c) { return std::isalnum(c) || c == '_'; };
      const auto end = std::find_if_not(rest.begin(), rest.end(), is_name);
      const std::string name(rest.begin(), end);
      if (annotations_ && end != rest.end() && *end == '[') {
        result += text[i++];
        continue;
      }
      report.error(where, "undefined parameter {}{}", in_quotes("$" + name),
                   did_you_mean(name, report.names_for_hint(parameters_)));
      return std::nullopt;
    }
    mark(meant->second);
    const Expansion& value = meant->second.value;
    result += value.text;
    if (define.empty()) define = value.define;
    i += 1 + meant->first.size();
    if (result.size() > kLongestValue) {
      report.error(where, "the value gets longer than {} bytes", kLongestValue);
      return std::nullopt;
    }
  }
  return Expansion{std::move(result), std::move(define)};
}

std::vector<std::pair<std::string, std::string>> Substitution::scene_parameters() const {
  std::vector<std::pair<std::string, std::string>> result(size_t(next_order_), {"", ""});
  for (const auto& [name, p] : parameters_)
    if (p.order >= 0) result[size_t(p.order)] = {name, p.value.text};
  return result;
}

}  // namespace duet
