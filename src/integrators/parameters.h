// The parameters of methods by name and as text: what -I sets and what file headers say.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "scene/description_integrators.h"

namespace duet {

/// A parameter of a method: how it is called, shown and set.
struct MethodParameter {
  std::string name;
  /// "" where the other parameters leave it without a meaning.
  std::function<std::string()> get;
  /// Throws std::invalid_argument, with a message for the user, for values that it cannot have.
  std::function<void(const std::string&)> set;
};

/// The parameters of the description's method; they refer to the description. One that has a
/// meaning only with a certain value of another comes after that one.
std::vector<MethodParameter> method_parameters(IntegratorDescription& integrator);

}  // namespace duet
