#include "xml/xml_document.h"

#include <algorithm>
#include <functional>

namespace duet {

std::unique_ptr<XmlDocument> XmlDocument::parse(XmlText text, Report& report) {
  std::unique_ptr<XmlDocument> xml(new XmlDocument(std::move(text)));
  std::string& t = xml->text_;
  if (t.find('\0') != std::string::npos) {
    report.error(xml->begin(),
                 "this is not an XML file in UTF-8 or UTF-16: it contains zero bytes");
    return nullptr;
  }
  const pugi::xml_parse_result result = xml->document_.load_buffer_inplace(
      t.data(), t.size(), pugi::parse_default, pugi::encoding_utf8);
  if (!result) {
    std::string reason = result.description();
    if (!reason.empty()) reason[0] = char(std::tolower(static_cast<unsigned char>(reason[0])));
    report.error(xml->source_.at(size_t(std::max<ptrdiff_t>(result.offset, 0))),
                 "this is not well-formed XML: {}", reason);
    return nullptr;
  }
  for (pugi::xml_node n : xml->document_.children())
    if (n.type() == pugi::node_element && n != xml->root()) {
      report.error(xml->where(n), "this is not well-formed XML: a second root element <{}>",
                   n.name());
      return nullptr;
    }
  return xml;
}

SourceLocation XmlDocument::at_name(const char* name, size_t before) const {
  const std::less<const char*> earlier;
  if (earlier(name, text_.data()) || !earlier(name, text_.data() + text_.size())) return begin();
  const size_t offset = size_t(name - text_.data());
  return source_.at(offset - std::min(before, offset));
}

SourceLocation XmlDocument::where(pugi::xml_node element) const {
  return at_name(element.name(), 1);
}

SourceLocation XmlDocument::where(pugi::xml_attribute attribute) const {
  return at_name(attribute.name(), 0);
}

void XmlDocument::remove_schema() {
  pugi::xml_node element = root();
  for (pugi::xml_attribute a = element.first_attribute(); a;) {
    const pugi::xml_attribute next = a.next_attribute();
    const std::string_view name = a.name();
    if (name == "xmlns" || name.starts_with("xmlns:") || name.starts_with("xsi:"))
      element.remove_attribute(a);
    a = next;
  }
}

}  // namespace duet
