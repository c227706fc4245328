// Replaces exp of double in the program it is linked into.
#include "harness/core/testing/planted_defects.hpp"

namespace ulpgate::testing {

namespace {
// The table is built on first use; the engines copy it later, when the command line first asks for a type.
[[maybe_unused]] const bool planted = [] {
  auto& table = const_cast<FunctionTable<double>&>(function_table<double>());
  table[static_cast<std::size_t>(FunctionId::exp)] = &batch_of<wrong_exp>;
  return true;
}();
}  // namespace

}  // namespace ulpgate::testing
