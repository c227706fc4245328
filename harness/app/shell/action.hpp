// Action: what the chosen verb does; set by the subcommand's callback.
#pragma once

#include <functional>

#include "harness/app/shell/failure.hpp"

namespace ulpgate::app {

using Action = std::function<Verdict()>;

}  // namespace ulpgate::app
