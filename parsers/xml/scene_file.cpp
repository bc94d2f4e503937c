#include "xml/scene_file.h"

#include <functional>

#include "values/text.h"

namespace duet {

namespace {

std::optional<FileVersion> parse_version(std::string_view text) {
  int parts[3] = {0, 0, 0};
  size_t i = 0;
  for (std::string_view rest = trim(text);; ++i) {
    const size_t dot = rest.find('.');
    const auto part = parse_integer(rest.substr(0, dot));
    if (i == 3 || !part || *part < 0 || *part > 1000) return std::nullopt;
    parts[i] = int(*part);
    if (dot == rest.npos) break;
    rest = rest.substr(dot + 1);
  }
  return FileVersion{parts[0], parts[1], parts[2]};
}

bool read_version(SceneFileXml& file, Report& report) {
  const pugi::xml_node root = file.xml->root();
  const pugi::xml_attribute attribute = root.attribute("version");
  if (!attribute) {
    report.error(file.xml->where(root), "<{}> needs the attribute \"version\"", root.name());
    return false;
  }
  const SourceLocation where = file.xml->where(attribute);
  const auto version = parse_version(attribute.value());
  if (!version) {
    report.error(where, "{} is not a version of the form 3.0.0", in_quotes(attribute.value()));
    return false;
  }
  if (*version < FileVersion{0, 4, 0}) {
    report.error(where,
                 "scenes of Mitsuba {} are not understood, only those of 0.4 to 3; Mitsuba 0.6 "
                 "can convert it",
                 attribute.value());
    return false;
  }
  if (version->major > 3)
    report.warning(where, "version {} is unknown; the scene is read as version 3",
                   attribute.value());
  file.version = *version;
  return true;
}

}  // namespace

std::optional<SceneFileXml> parse_scene_file(std::string bytes, const std::string& path,
                                             const FileAccess& access, Report& report) {
  const auto name = std::make_shared<const std::string>(path);
  auto utf8 = to_utf8(std::move(bytes));
  if (!utf8) {
    report.error({name, 1, 1}, "this is not an XML file in UTF-8 or UTF-16");
    return std::nullopt;
  }
  XmlText::PlaceOfLine place;
  if (access.place) place = std::bind_front(access.place, path);
  XmlText text(std::move(*utf8), name, std::move(place));
  std::optional<XmlText> with_entities;
  if (text.declares_entities()) with_entities = text;
  SceneFileXml file;
  file.xml = XmlDocument::parse(std::move(text), report);
  if (!file.xml || !read_version(file, report)) return std::nullopt;
  // The parser of Mitsuba 2 and 3 leaves entities as they are.
  if (!file.version.is_0x()) return file;
  if (with_entities) {
    file.xml = XmlDocument::parse(with_entities->replace_entities(access.read, report), report);
    if (!file.xml) return std::nullopt;
  }
  // Xerces, which 0.x uses, lets a root name its schema.
  file.xml->remove_schema();
  return file;
}

}  // namespace duet
