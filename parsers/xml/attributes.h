// The attributes of one element, with parameters replaced.
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "xml/substitution.h"
#include "xml/xml_document.h"

namespace duet {

class Attributes {
 public:
  Attributes(const XmlDocument& xml, pugi::xml_node element, Substitution& substitution,
             Report& report);

  /// Reports attributes that are not in `known` and the missing ones of those that are marked with
  /// "!". True if everything is as it should be.
  bool check(std::initializer_list<std::string_view> known) const;

  bool has(std::string_view name) const { return find(name); }
  /// The value, or "" if the attribute is missing.
  const std::string& operator[](std::string_view name) const;
  /// The same with the definition of the caller's that it contains.
  Expansion expansion(std::string_view name) const;
  /// The attribute's place, or the element's if it is missing. Where the value comes from a
  /// definition of the caller's, that is the place; it names the one in the file.
  const SourceLocation& where(std::string_view name) const;
  const SourceLocation& where() const { return where_; }
  /// The place of what is wrong with all attributes together: that of the first definition of the
  /// caller's among them, or the element.
  const SourceLocation& where_all() const;

 private:
  struct Attribute {
    std::string name, value;
    SourceLocation where;
    std::string define;
  };
  const Attribute* find(std::string_view name) const;

  std::string element_;
  std::vector<Attribute> attributes_;
  SourceLocation where_;
  Report& report_;
  bool valid_ = true;
};

}  // namespace duet
