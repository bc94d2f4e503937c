// An XML file with the places of its elements and attributes.
#pragma once

#include <memory>
#include <pugixml.hpp>
#include <string>
#include <vector>

#include "xml/xml_text.h"

namespace duet {

class XmlDocument {
 public:
  /// Null, with an error in `report`, if the text is not well-formed XML. Entities that a document
  /// type declares are left as they are.
  static std::unique_ptr<XmlDocument> parse(XmlText text, Report& report);

  /// Takes away the root's attributes that name a schema.
  void remove_schema();
  pugi::xml_node root() const { return document_.document_element(); }
  /// Where the element's "<" is.
  SourceLocation where(pugi::xml_node element) const;
  /// Where the attribute's name begins.
  SourceLocation where(pugi::xml_attribute attribute) const;
  /// The first line: the place of what concerns the whole file.
  SourceLocation begin() const { return source_.at(0); }

 private:
  explicit XmlDocument(XmlText source) : source_(std::move(source)), text_(source_.release()) {}
  /// pugixml leaves names where they are in the text.
  SourceLocation at_name(const char* name, size_t before) const;

  XmlText source_;
  std::string text_;  ///< the parser writes into it
  pugi::xml_document document_;
};

}  // namespace duet
