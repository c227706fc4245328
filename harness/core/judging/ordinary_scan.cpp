// The scan, for several instruction sets.  Every operation is exactly rounded and none is contracted: where
// two of them settle a sample they write the same verdict.
#include "harness/core/judging/ordinary_scan.hpp"

#include <algorithm>
#include <cstring>
#include <limits>
#include <type_traits>
#include <utility>

#include "harness/core/judging/native_bits.hpp"
#include "harness/core/judging/ordinary_errors.hpp"

namespace ulpgate {

namespace {

using Limits = std::numeric_limits<float>;

// One ulp of binary64 in ulp of binary32, with a margin.
constexpr double unit = power_of_two(Limits::digits - 53) * (1 + 0x1p-20);
// One ulp of double-double in ulp of binary64, with a margin.
constexpr double wide_unit = power_of_two(53 - significand_bits<DoubleDouble>) * (1 + 0x1p-20);
// Stands for every error that is not zero and too small to tell.
constexpr double tiny = 0x1p-1000;

namespace baseline {
constexpr std::size_t width = 2;
// clang-format off
#include "harness/core/judging/scan_vectors.inc"
#include "harness/core/judging/ordinary_scan_kernel.inc"
#include "harness/core/judging/scan_in_binary32.inc"
// clang-format on
}  // namespace baseline

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#define ULPGATE_SCAN_LEVELS
#pragma GCC push_options
#pragma GCC target("arch=x86-64-v3")
namespace avx2 {
constexpr std::size_t width = 4;
// clang-format off
#include "harness/core/judging/scan_vectors.inc"
#include "harness/core/judging/ordinary_scan_kernel.inc"
#include "harness/core/judging/scan_in_binary32.inc"
// clang-format on
}  // namespace avx2
#pragma GCC pop_options
#pragma GCC push_options
#pragma GCC target("arch=x86-64-v4")
namespace avx512 {
constexpr std::size_t width = 8;
// clang-format off
#include "harness/core/judging/scan_vectors.inc"
#include "harness/core/judging/ordinary_scan_kernel.inc"
#include "harness/core/judging/scan_in_binary32.inc"
// clang-format on
}  // namespace avx512
#pragma GCC pop_options
#endif

template <class Input, std::size_t (*scan)(const Input&, std::uint8_t*)>
void scan_all(const Input& in, std::uint8_t* verdicts) {
  const std::size_t done = scan(in, verdicts);
  std::fill(verdicts + done, verdicts + in.count, verdict::unsettled);
}

// Of each instruction set that this processor has, the fastest last.
template <class Scan>
std::vector<Scan> supported([[maybe_unused]] Scan baseline, [[maybe_unused]] Scan avx2,
                            [[maybe_unused]] Scan avx512) {
  std::vector<Scan> scans = {baseline};
#ifdef ULPGATE_SCAN_LEVELS
  if (__builtin_cpu_supports("x86-64-v3") != 0) scans.push_back(avx2);
  if (__builtin_cpu_supports("x86-64-v4") != 0) scans.push_back(avx512);
#endif
  return scans;
}

#ifndef ULPGATE_SCAN_LEVELS
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
