// One scene file as XML, with its version.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "files/file_access.h"
#include "xml/property_value.h"
#include "xml/xml_document.h"

namespace duet {

struct SceneFileXml {
  std::unique_ptr<XmlDocument> xml;
  FileVersion version;
};

/// Parses the bytes of the file `path`: in whatever encoding, in files of 0.x with entities
/// replaced and without what names a schema. Nothing after an error.
std::optional<SceneFileXml> parse_scene_file(std::string bytes, const std::string& path,
                                             const FileAccess& access, Report& report);

}  // namespace duet
