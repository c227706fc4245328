// Lists of implementations: TOML files of functions of libraries, and what is claimed of them.
#pragma once

#include <string>
#include <vector>

#include "harness/core/subject/subject.hpp"
#include "harness/foreign/claimed_code.hpp"
#include "harness/foreign/foreign_spec.hpp"

namespace ulpgate::app {

struct ListedFunction {
  std::string function;
  std::string type;
  ForeignSpec spec;
  ClaimBounds claim;
  std::string name;   // of the library with its version, for records; empty: that of its file
  std::string place;  // "FILE:LINE: ", for messages; empty where it stands on the command line
};

// The rows of a list (README.md of this room), `functions` expanded, in the order of the file.  Throws a
// Failure that names file and line.
[[nodiscard]] std::vector<ListedFunction> read_implementations(const std::string& file,
                                                               const std::string& text,
                                                               const ForeignSpec& common);

struct BoundFunction {
  const Subject* subject = nullptr;  // null where this processor cannot run it, which was said
  const BatchCode* code = nullptr;   // as its claim has it
  char element = 'd';
  ForeignFacts facts;
};
// From now on it stands for its function and type.
BoundFunction bind_listed(const ListedFunction& row);

}  // namespace ulpgate::app
