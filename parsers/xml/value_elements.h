// Elements that hold a value: <float>, <rgb>, <transform> …
#pragma once

#include <string_view>

#include "files/file_access.h"
#include "xml/attributes.h"
#include "xml/property_value.h"

namespace duet {

/// What is needed to understand the elements of one file.
struct ElementContext {
  const XmlDocument& xml;
  FileVersion version;
  Substitution& substitution;
  const FileAccess& access;
  const std::vector<std::string>& folders;
  Report& report;
};

/// Whether the element holds a value (and not a plugin).
bool is_value_element(std::string_view tag);
const std::vector<std::string>& value_elements();

/// The value of such an element; Broken, with an error, if it has none.
PropertyValue read_value(const ElementContext& context, pugi::xml_node element,
                         const Attributes& attributes);

/// Whether a transform acts in space or on texture coordinates, whose z does not matter.
enum class TransformSpace { world, uv };
/// The product of the steps in a <transform>; Broken, with errors, if one of them is wrong.
PropertyValue read_transform(const ElementContext& context, pugi::xml_node element,
                             TransformSpace space = TransformSpace::world);

/// The transforms in an <animation>, in the order of their times, or the only one that they are;
/// Broken, with errors, if they make no motion.
PropertyValue read_animation(const ElementContext& context, pugi::xml_node element);

/// A unit vector orthogonal to the unit vector `d`, as the file's version chooses it.
Triple orthogonal_vector(const Triple& d, FileVersion version);

}  // namespace duet
