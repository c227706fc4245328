// Arguments of a kernel: drawn from its ranges, and where ranges have corners.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "harness/interface/include/ulpgate/ulpgate.h"

namespace ulpgate::kernel_test {

// A stratum's points, arguments side by side, as numbers of the type ("float", "double", "long double").
struct Points {
  std::string stratum;
  std::vector<long double> values;
};

// uniform: in value; spread: signs and exponents first, so that small numbers are as frequent as large ones;
// near: all arguments close to the first or to its negative, where differences cancel; edges: ends of the
// ranges, zeros and ones with their neighbours.  extremes, where asked for: the smallest numbers, subnormal
// ones among them, and what the type has at its largest, as far as the ranges reach.  Depends on the seed
// alone.
[[nodiscard]] std::vector<Points> points_of(const ulpgate_kernel& kernel, std::uint64_t samples,
                                            std::uint64_t seed, bool extremes);

}  // namespace ulpgate::kernel_test
