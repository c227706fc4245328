// Arguments of functions of one variable whose results lie next to a midpoint of two numbers, or next to a
// number: those that are hardest to round.
#pragma once

#include <cstdint>
#include <vector>

#include "harness/core/arguments/argument_lists.hpp"

namespace ulpgate {

struct NearMidpoint {
  MpfrValue argument;
  double distance_ulp;  // of the exact result to the midpoint or number next to it; never 0
  bool midpoint;
};

// Where the exact f(x) lies: its distance to the nearest midpoint or number of the format.
[[nodiscard]] NearMidpoint hardness_of(const FunctionInfo& f, const FloatFormat& format, mpfr_srcptr x);

// Up to `count` points, fixed by the seed, half of them next to midpoints; each is the best of `windows`
// windows.  None for functions that are not real functions of one argument, or only have results that are
// numbers of the format (logb).  For formats of up to 64 digits: in wider ones most of the arguments drawn
// are so small that the function is its argument to all digits, or constant.
//
// Next to x, f(x + k u) for the spacing u is a + b k + c k^2 ULP; where c k^2 is small, the k that bring it
// closest to a midpoint follow from the continued fraction of b.  That is the linear case of the search for
// worst cases of Lefevre ("An algorithm that computes a lower bound on the distance between a segment and
// Z^2", 1999; Lefevre and Muller, "Worst cases for correct rounding of the elementary functions in double
// precision", ARITH 2001) and of Stehle, Lefevre and Zimmermann ("Searching worst cases of a one-variable
// function using lattice reduction", IEEE Trans. Comput. 54 (2005) 340), without their proof that nothing was
// missed.  A window of N numbers comes within about 1/N ULP, N being c^(-1/3): 2^18 in binary64 where x and
// f(x) are about 1, 2^30 and more where f is next to a straight line of slope close to a simple fraction.
[[nodiscard]] std::vector<NearMidpoint> near_midpoints(const FunctionInfo& f, const FloatFormat& format,
                                                       std::size_t count, std::uint64_t seed,
                                                       int windows = 1);

}  // namespace ulpgate
