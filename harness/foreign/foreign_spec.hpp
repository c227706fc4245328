// ForeignSpec: which foreign code stands for a function, in the words of the command line.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace ulpgate {

struct ForeignSpec {
  std::string library;    // path or name, as the loader takes it; "-": the worker itself
  std::string symbol;     // "Sleef_sin_u10"
  std::string signature;  // of worker_signature.h; empty: one that the symbol's name or the function tells
  std::string worker;     // program; empty: the one beside this program
  std::vector<std::string> environment;  // NAME=VALUE, added to the worker's
  double timeout_s = 1;                  // of processor time, in one call
  std::optional<double> claimed_ulp;

  // The options of a command line that select it, each word quoted for a shell where it must be.
  [[nodiscard]] std::string selection() const;
};

// The signature that a symbol's name tells, of the vector ABI or SLEEF's, else values of the type.
[[nodiscard]] std::string default_signature(const std::string& symbol, char element, int arity);

// What a worker told of what it loaded.
struct ForeignFacts {
  std::string path;
  std::string soname;
  std::string build_id;
  std::string signature;
  std::vector<std::string> findings;  // "sets flushing of subnormals to zero on loading (MXCSR 1f80 -> 9fc0)"

  // "libsleef.so.3.5.1 Sleef_sin_u10".
  [[nodiscard]] std::string name_with(const std::string& symbol) const;
};

}  // namespace ulpgate
