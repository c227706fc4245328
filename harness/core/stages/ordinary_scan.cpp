// The scan, for several instruction sets.  Every operation is exactly rounded and none is contracted: where
// two of them settle a sample they write the same verdict.
#include "harness/core/stages/ordinary_scan.hpp"

#include <algorithm>
#include <cstring>
#include <limits>
#include <type_traits>
#include <utility>

#include "harness/core/stages/native_bits.hpp"
#include "harness/core/stages/ordinary_errors.hpp"
#include "reference/lanes/levels.hpp"

namespace ulpgate {

namespace {

using Limits = std::numeric_limits<float>;

// One ulp of binary64 in ulp of binary32, with a margin.
constexpr double unit = power_of_two(Limits::digits - 53) * (1 + 0x1p-20);
// One ulp of double-double in ulp of binary64, with a margin.
constexpr double wide_unit = power_of_two(53 - significand_bits<DoubleDouble>) * (1 + 0x1p-20);
// In units of the least subnormal, what stands for a zero with a bound (double_double_functions.hpp).
constexpr double wide_zero_error = power_of_two(double_double_zero + 1 - (-1074));
// Stands for every error that is not zero and too small to tell.
constexpr double tiny = 0x1p-1000;

#define ULPGATE_LEVEL_FILE "harness/core/stages/scan_in_binary32.inc"
#include "reference/lanes/each_level.inc"

template <class Input, std::size_t (*scan)(const Input&, std::uint8_t*)>
void scan_all(const Input& in, std::uint8_t* verdicts) {
  const std::size_t done = scan(in, verdicts);
  std::fill(verdicts + done, verdicts + in.count, verdict::unsettled);
}

// Of each instruction set that this processor has, the fastest last.
template <class Scan>
std::vector<Scan> supported(Scan baseline, Scan avx2, Scan avx512) {
  std::vector<Scan> scans = {baseline};
  const std::size_t levels = instruction_levels();
  if (levels > 1) scans.push_back(avx2);
  if (levels > 2) scans.push_back(avx512);
  return scans;
}

#ifndef ULPGATE_LEVELS
namespace avx2 = baseline;
namespace avx512 = baseline;
#endif

}  // namespace

std::vector<OrdinaryScan> ordinary_scans() {
  return supported<OrdinaryScan>(scan_all<ScanInput, baseline::scan>, scan_all<ScanInput, avx2::scan>,
                                 scan_all<ScanInput, avx512::scan>);
}

std::vector<WideScan> wide_scans() {
  return supported<WideScan>(scan_all<WideScanInput, baseline::scan_wide>,
                             scan_all<WideScanInput, avx2::scan_wide>,
                             scan_all<WideScanInput, avx512::scan_wide>);
}

void scan_ordinary(const WideScanInput& in, std::uint8_t* verdicts) {
  static const WideScan best = wide_scans().back();
  best(in, verdicts);
}

void scan_ordinary(const ScanInput& in, std::uint8_t* verdicts) {
  static const OrdinaryScan best = ordinary_scans().back();
  best(in, verdicts);
}

}  // namespace ulpgate
