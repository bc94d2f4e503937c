// What is known of plugins by their names, for scenes that are no XML.
#pragma once

#include <string>
#include <vector>

namespace duet::python {

/// The elements ("bsdf", "shape" …) that a plugin of this type can be within an `outer` one.
std::vector<std::string> plugin_kinds(const std::string& type, const std::string& outer);

/// The type of a parameter as `duet plugins` prints it ("integer", "colour or texture"); "" if the
/// plugin is not known or has no such parameter.
std::string parameter_type(const std::string& element, const std::string& type,
                           const std::string& name);

}  // namespace duet::python
