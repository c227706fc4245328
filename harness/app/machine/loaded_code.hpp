// Loaded code: which libraries and which variants of their functions this process got from the loader.
#pragma once

#include <map>
#include <string>

namespace ulpgate::app {

struct LoadedLibrary {
  std::string path;
  std::string build_id;  // hexadecimal; empty where the linker wrote none
};

// By file name: the C library's mathematics, libquadmath, MPFR, MPC and GMP as far as they are loaded, and
// any other library that one of the math functions comes from, such as a preloaded one.
[[nodiscard]] std::map<std::string, LoadedLibrary> loaded_libraries();

// A hash over every math function of the C library: which code its name stands for, as library and offset.
// The loader chooses among variants by processor and GLIBC_TUNABLES; addresses, which change from run to run,
// are no part of it.
[[nodiscard]] std::string function_variants();

// Instruction sets that the C library uses here, "AVX AVX2 FMA": what the processor has less what
// GLIBC_TUNABLES masks.  Empty where the C library does not tell.
[[nodiscard]] std::string active_instruction_sets();

}  // namespace ulpgate::app
