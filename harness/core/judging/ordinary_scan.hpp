// Scans of a batch of binary32 results against binary64 references, and of binary64 results against
// double-double ones: they settle the ordinary ones, many at a time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "harness/core/judging/exact_results.hpp"
#include "reference/double_double/double_double.hpp"

namespace ulpgate {

// What a scan says of one sample: 2 * slot + 1 where OrdinaryErrors rounds the error up to the slot's upper
// edge, 2 * slot where down to the lower one, or one of these.
namespace verdict {
// Exact: NaN for NaN, infinity for infinity, and equal to a value that has no error.
inline constexpr std::uint8_t agreed = 18;
inline constexpr std::uint8_t unsettled = 255;
}  // namespace verdict

struct ScanInput {
  const float* args;  // of one argument each
  const float* results;
  const double* values;
  const double* bounds;  // of the values, in ulp of binary64; negative: nothing is known
  std::size_t count;
  std::uint64_t first_index;  // of the row's points
  double largest_error;       // recorded so far; nothing that could reach it is settled
  InexactResults inexact;
};

// Of functions of one argument or more: args is null where there are more.
struct WideScanInput {
  const double* args;
  const double* results;
  const DoubleDouble* values;
  const double* bounds;  // of the values, in ulp of double-double; negative: nothing is known
  std::size_t count;
  std::uint64_t first_index;
  double largest_error;
  InexactResults inexact;
};

// Writes a verdict for each sample.  Settled are results that are the correctly rounded ones, whose error is
// surely no maximum and surely in one bucket and on one side of the mean's threshold, and agreed special
// results; NativeStage::find says the same of them.
void scan_ordinary(const ScanInput& in, std::uint8_t* verdicts);
void scan_ordinary(const WideScanInput& in, std::uint8_t* verdicts);

// The same for each instruction set that this processor has, the fastest last.  They may leave different
// numbers of samples at the end of a batch unsettled, for the caller to look at one by one.
using OrdinaryScan = void (*)(const ScanInput& in, std::uint8_t* verdicts);
[[nodiscard]] std::vector<OrdinaryScan> ordinary_scans();
using WideScan = void (*)(const WideScanInput& in, std::uint8_t* verdicts);
[[nodiscard]] std::vector<WideScan> wide_scans();

}  // namespace ulpgate
