// Instruction sets for which functions of many numbers are compiled (each_level.inc).
#pragma once

#include <cstddef>
#include <cstdint>
#include <stdexcept>

// Where ULPGATE_ONE_LEVEL is defined a source has the first of them alone.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(ULPGATE_ONE_LEVEL)
#define ULPGATE_LEVELS
#include <immintrin.h>
#endif

// Never called: a function of one instruction set must not become another's.
#define ULPGATE_INLINE [[gnu::always_inline]] inline

namespace ulpgate {

class UnknownInstructions : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

// How many of them this program uses, the slowest first: 1 that of every processor, 2 AVX2 with FMA
// (x86-64-v3) as well, 3 AVX-512 (x86-64-v4) as well.  As many as the processor has, and no more than the
// environment's ULPGATE_INSTRUCTIONS says: baseline, avx2 or avx512.  Throws UnknownInstructions where that
// is another word.
[[nodiscard]] std::size_t instruction_levels();

}  // namespace ulpgate
