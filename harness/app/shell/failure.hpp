// Failure: an expected failure of a command, with what it comes to and a message that says what and where.
#pragma once

#include <stdexcept>
#include <string>

#include "harness/core/verdict/verdict.hpp"

namespace ulpgate::app {

class Failure : public std::runtime_error {
 public:
  Failure(Standing standing, const std::string& message) : std::runtime_error(message), standing_(standing) {}
  [[nodiscard]] Standing standing() const { return standing_; }

 private:
  Standing standing_;
};

}  // namespace ulpgate::app
