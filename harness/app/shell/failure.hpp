// Failure: an expected failure of a command, with the exit code and a message that says what and where.
#pragma once

#include <stdexcept>
#include <string>

namespace ulpgate::app {

enum class ExitCode : int {
  pass = 0,
  regression = 1,   // accuracy regression, or the oracles disagree
  bad_input = 2,    // bad usage or input
  incomplete = 3,   // nothing measured, or not all of it
  environment = 4,  // crash, time-out or I/O failure
};

class Failure : public std::runtime_error {
 public:
  Failure(ExitCode code, const std::string& message) : std::runtime_error(message), code_(code) {}
  [[nodiscard]] ExitCode code() const { return code_; }

 private:
  ExitCode code_;
};

}  // namespace ulpgate::app
