#include "xml/attributes.h"

#include "values/text.h"

namespace duet {

namespace {

/// A definition on the command line with the place where it is used.
SourceLocation place_of(const std::string& define, const SourceLocation& used) {
  const std::string quoted = in_quotes(define);  // cut, and without control characters
  const std::string shown = quoted.substr(1, quoted.size() - 2);
  return {std::make_shared<const std::string>(fmt::format("-D {} ({})", shown, used.to_string()))};
}

}  // namespace

Attributes::Attributes(const XmlDocument& xml, pugi::xml_node element, Substitution& substitution,
                       Report& report)
    : element_(element.name()), where_(xml.where(element)), report_(report) {
  for (pugi::xml_attribute a : element.attributes()) {
    Attribute attribute{a.name(), a.value(), xml.where(a), ""};
    if (find(attribute.name)) {
      report.error(attribute.where, "<{}> has two attributes {}", element_,
                   in_quotes(attribute.name));
      valid_ = false;
      continue;
    }
    if (attribute.value.find('$') != std::string::npos) {
      if (auto value = substitution.expand(attribute.value, attribute.where, report)) {
        attribute.value = std::move(value->text);
        attribute.define = std::move(value->define);
        if (!attribute.define.empty())
          attribute.where = place_of(attribute.define, attribute.where);
      } else {
        valid_ = false;
      }
    }
    attributes_.push_back(std::move(attribute));
  }
}

const Attributes::Attribute* Attributes::find(std::string_view name) const {
  for (const Attribute& a : attributes_)
    if (a.name == name) return &a;
  return nullptr;
}

bool Attributes::check(std::initializer_list<std::string_view> known) const {
  bool good = valid_;
  std::vector<std::string> names;
  for (std::string_view k : known) {
    const bool required = k.starts_with('!');
    if (required) k.remove_prefix(1);
    names.emplace_back(k);
    if (required && !find(k)) {
      report_.error(where_, "<{}> needs the attribute \"{}\"", element_, k);
      good = false;
    }
  }
  for (const Attribute& a : attributes_) {
    bool found = false;
    for (const std::string& n : names) found |= n == a.name;
    if (found) continue;
    report_.error(a.where, "<{}> has no attribute {}{}", element_, in_quotes(a.name),
                  did_you_mean(a.name, names));
    good = false;
  }
  return good;
}

const std::string& Attributes::operator[](std::string_view name) const {
  static const std::string empty;
  const Attribute* a = find(name);
  return a ? a->value : empty;
}

Expansion Attributes::expansion(std::string_view name) const {
  const Attribute* a = find(name);
  return a ? Expansion{a->value, a->define} : Expansion{};
}

const SourceLocation& Attributes::where_all() const {
  for (const Attribute& a : attributes_)
    if (!a.define.empty()) return a.where;
  return where_;
}

const SourceLocation& Attributes::where(std::string_view name) const {
  const Attribute* a = find(name);
  return a ? a->where : where_;
}

}  // namespace duet
