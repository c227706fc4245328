// Scans of a batch of binary32 results against binary64 references, and of binary64 results against
// double-double ones: they settle the ordinary ones, many at a time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "harness/core/stages/exact_results.hpp"
#include "reference/multi_word/double_double.hpp"

namespace ulpgate {

// What a scan says of one sample: 2 * slot + 1 where the mean rounds the error up to the upper edge of the
// slot of OrdinaryErrors, 2 * slot where down to the lower one, or one of these.
namespace verdict {
// Exact: NaN for NaN, infinity for infinity, and equal to a value that has no error.
inline constexpr std::uint8_t agreed = 62;
inline constexpr std::uint8_t unsettled = 255;
}  // namespace verdict

// What is recorded so far, which nothing that is settled may exceed.
struct ScanLimits {
  double largest_error;
  // Of errors above 1/2 ULP.
  double error_over_condition;
  double max_distance;
  // Whether a tie, an error of 1/2 ULP without a bound, raises no maximum.
  bool half_is_seen = false;
};

struct ScanInput {
  const float* args;  // of one argument each
  const float* results;
  const double* values;
  const double* bounds;  // of the values, in ulp of binary64; negative: nothing is known
  std::size_t count;
  std::uint64_t first_index;  // of the row's points
  ScanLimits limits;
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
  ScanLimits limits;
  InexactResults inexact;
};

// Writes a verdict for each sample.  Settled are results whose error is surely below 1/2 or, up to 4 ULP,
// surely above, no maximum, in one bucket and on one side of the mean's threshold, and agreed special
// results; NativeStage::find says the same of them.
void scan_ordinary(const ScanInput& in, std::uint8_t* verdicts);
void scan_ordinary(const WideScanInput& in, std::uint8_t* verdicts);

// The same for each instruction set that this processor has, the fastest last.  They may leave different
// samples unsettled, for the caller to look at one by one: at the end of a batch, and of binary32 those
// closer to a threshold than binary32 tells.
using OrdinaryScan = void (*)(const ScanInput& in, std::uint8_t* verdicts);
[[nodiscard]] std::vector<OrdinaryScan> ordinary_scans();
using WideScan = void (*)(const WideScanInput& in, std::uint8_t* verdicts);
[[nodiscard]] std::vector<WideScan> wide_scans();

}  // namespace ulpgate
