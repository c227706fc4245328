// The scan, for several instruction sets.  Every operation is exactly rounded and none is contracted, so all
// of them write the same verdicts.
#include "harness/core/judging/ordinary_scan.hpp"

#include <algorithm>
#include <cstring>
#include <limits>

#include "harness/core/judging/native_bits.hpp"
#include "harness/core/judging/ordinary_errors.hpp"

namespace ulpgate {

namespace {

using Limits = std::numeric_limits<float>;

// One ulp of binary64 in ulp of binary32, with a margin.
constexpr double unit = power_of_two(Limits::digits - 53) * (1 + 0x1p-20);
// Stands for every error that is not zero and too small to tell.
constexpr double tiny = 0x1p-1000;

namespace baseline {
constexpr std::size_t width = 2;
#include "harness/core/judging/ordinary_scan_kernel.inc"
}  // namespace baseline

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#define ULPGATE_SCAN_LEVELS
#pragma GCC push_options
#pragma GCC target("arch=x86-64-v3")
namespace avx2 {
constexpr std::size_t width = 4;
#include "harness/core/judging/ordinary_scan_kernel.inc"
}  // namespace avx2
#pragma GCC pop_options
#pragma GCC push_options
#pragma GCC target("arch=x86-64-v4")
namespace avx512 {
constexpr std::size_t width = 8;
#include "harness/core/judging/ordinary_scan_kernel.inc"
}  // namespace avx512
#pragma GCC pop_options
#endif

template <std::size_t (*scan)(const ScanInput&, std::uint8_t*)>
void scan_all(const ScanInput& in, std::uint8_t* verdicts) {
  const std::size_t done = scan(in, verdicts);
  std::fill(verdicts + done, verdicts + in.count, verdict::unsettled);
}

}  // namespace

std::vector<OrdinaryScan> ordinary_scans() {
  std::vector<OrdinaryScan> scans = {scan_all<baseline::scan>};
#ifdef ULPGATE_SCAN_LEVELS
  if (__builtin_cpu_supports("x86-64-v3") != 0) scans.push_back(scan_all<avx2::scan>);
  if (__builtin_cpu_supports("x86-64-v4") != 0) scans.push_back(scan_all<avx512::scan>);
#endif
  return scans;
}

void scan_ordinary(const ScanInput& in, std::uint8_t* verdicts) {
  static const OrdinaryScan best = ordinary_scans().back();
  best(in, verdicts);
}

}  // namespace ulpgate
