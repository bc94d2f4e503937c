// What can be seen in a pbrt file without reading the scene.
#pragma once

#include <map>
#include <string>

#include "pbrt/lexer.h"

namespace duet::batch {

/// Takes the strings, numbers and brackets to the next word or the end. Yields the first number of
/// each parameter that has any, by its name without its type. Throws pbrt::SyntaxError.
std::map<std::string, double> take_parameters(pbrt::Lexer& in);

}  // namespace duet::batch
