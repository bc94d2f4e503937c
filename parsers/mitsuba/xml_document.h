// An XML file with the places of its elements and attributes.
#pragma once

#include <memory>
#include <pugixml.hpp>
#include <string>
#include <vector>

#include "mitsuba/report.h"

namespace duet {

class XmlDocument {
 public:
  /// Null, with an error in `report`, if the text is not well-formed XML. Entities that a document
  /// type declares are not expanded.
  static std::unique_ptr<XmlDocument> parse(std::string text,
                                            std::shared_ptr<const std::string> file,
                                            Report& report);

  pugi::xml_node root() const { return document_.document_element(); }
  /// Where the element's "<" is.
  SourceLocation where(pugi::xml_node element) const;
  /// Where the attribute's name begins.
  SourceLocation where(pugi::xml_attribute attribute) const;
  /// The first line: the place of what concerns the whole file.
  SourceLocation begin() const { return {file_, 1, 1}; }

 private:
  XmlDocument() = default;
  SourceLocation at(size_t offset) const;
  /// pugixml leaves names where they are in the text.
  SourceLocation at_name(const char* name, size_t before) const;

  std::shared_ptr<const std::string> file_;
  std::string text_;
  std::vector<size_t> line_starts_;
  pugi::xml_document document_;
};

}  // namespace duet
