// ForeignFailure: foreign code that cannot be tested, as it was asked for.
#pragma once

#include <stdexcept>

namespace ulpgate {

// The library, symbol, signature or worker is wrong: what() names which and why.
class ForeignFailure : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

// This processor cannot run it.
class ForeignUnsupported : public ForeignFailure {
  using ForeignFailure::ForeignFailure;
};

// It can be called, but does not come to an end: it hangs too often.
class ForeignHangs : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace ulpgate
