// Large angles of binary128 as turns.
#pragma once

#include <cstdint>

#include "reference/multi_word/triple_double.hpp"

namespace ulpgate {

// A quarter of a turn `quadrant` times, and a fraction of one, in [-1/2, 1/2], within 2^-157 of itself.
struct QuarterTurns {
  TripleDouble fraction;
  int quadrant;
};

// |x| = (high 2^64 + low) 2^(exponent - 112), a number of 113 bits, exponent from 0 on; 2 / pi times x modulo
// 4 by M. Payne and R. Hanek (SIGNUM Newsletter 18 (1983) 19): of 448 bits of 2 / pi those above multiples of
// 4 are left out, and 335 bits of the fraction are right, of which no number of 113 bits and 16384 binades
// cancels more than some 130.
[[nodiscard]] QuarterTurns quarter_turns(std::uint64_t high, std::uint64_t low, int exponent);

}  // namespace ulpgate
