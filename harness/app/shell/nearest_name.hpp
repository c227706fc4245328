// The known name that a misspelt one was meant for.
#pragma once

#include <string>
#include <vector>

namespace ulpgate::app {

// "; did you mean 'sin'?" where one of the known names is near, else nothing.
[[nodiscard]] std::string nearest_hint(const std::string& name, const std::vector<std::string>& known);

}  // namespace ulpgate::app
