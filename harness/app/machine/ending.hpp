// Ending: how a program does its verb and what it ends with, the same for every program.
#pragma once

#include <string>

#include "harness/app/shell/action.hpp"
#include "harness/core/verdict/verdict.hpp"

namespace CLI {
class App;
}

namespace ulpgate::app {

struct Ending {
  Standing standing = Standing::pass;
  std::string message;  // empty where all is well
};

// Does the verb between two looks at the floating-point environment, under a watchdog, and turns whatever it
// throws into an ending: failures as they are, memory and threads that are not to be had as environment.
[[nodiscard]] Ending end_of(const Action& action, double timeout_s);

// For a command line that has no verb of `app`: names the wrong word and the nearest verb.  Empty where the
// fault is another.
[[nodiscard]] std::string wrong_verb(const CLI::App& app, int argc, const char* const* argv);

}  // namespace ulpgate::app
