// ReferenceDisagreement: the screen and the full reference differ by more than the screen's bound, so one of
// them is wrong; nothing measured with them counts.
#pragma once

#include <stdexcept>

namespace ulpgate {

class ReferenceDisagreement : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace ulpgate
