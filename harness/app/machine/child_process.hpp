// Child process: another program, or this one again, run to its end.
#pragma once

#include <string>
#include <vector>

namespace ulpgate::app {

enum class ChildErrors { shown, dropped };

struct ChildOutput {
  int exit_code = 0;  // 127 where it could not be started, 128 and more for a signal
  std::string text;   // what it wrote to its standard output
};

// Found on the PATH; with the environment of this process.  Throws a Failure, environment, where no process
// or pipe is to be had.
[[nodiscard]] ChildOutput output_of(const std::vector<std::string>& words, ChildErrors errors);

// The file of this very program.
[[nodiscard]] std::string own_program();

}  // namespace ulpgate::app
