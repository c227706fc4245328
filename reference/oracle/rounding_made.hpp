// RoundingMade: what is known of a rounding of an exact value, and which way the value was found.
#pragma once

namespace ulpgate::oracle {

// A formula of ours answers only where its error bound decides the rounding; MPFR answers everywhere.  Tests
// ask who did: an oracle that always fell back would be right, and slow.
enum class Method { formula, mpfr };

struct RoundingMade {
  int ternary = 0;  // as MPFR's: its sign tells the direction of the rounding, 0 that there was none
  Method method = Method::mpfr;
};

}  // namespace ulpgate::oracle
