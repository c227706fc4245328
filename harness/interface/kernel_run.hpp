// What a kernel's results are worth: judged against its wide numbers.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "harness/interface/kernel_points.hpp"
#include "reference/ulp/ulp.hpp"

namespace ulpgate::kernel_test {

// One point, of one part of the result.
struct PartAt {
  std::string got;      // hexadecimal
  std::string decimal;  // 17 digits, or as many as the type needs
  std::string exact;    // decimal, 25 digits
  Judgement judgement;
  // What half a unit of each argument costs, in units of the result: C(f) of relative changes.  NaN where the
  // wide function gives no number.
  double condition = 0;
};

struct PartRow {
  std::string stratum;
  int part = 0;
  std::uint64_t samples = 0;
  double largest_ulp = -1;  // -1: nothing could be judged
  double mean_ulp = 0;
  std::vector<long double> args;
  std::map<std::string, std::uint64_t> mismatches;
  std::map<std::string, std::vector<long double>> mismatch_args;  // of the first of each
};

[[nodiscard]] std::vector<PartRow> run_kernel(const ulpgate_kernel& kernel, std::uint64_t samples,
                                              std::uint64_t seed, bool extremes);
[[nodiscard]] std::vector<PartAt> look_at(const ulpgate_kernel& kernel, const std::vector<long double>& args);

[[nodiscard]] std::string hexfloat(const ulpgate_kernel& kernel, long double x);
// A decimal or hexadecimal number, rounded to the kernel's type.
[[nodiscard]] long double parse_number(const ulpgate_kernel& kernel, const std::string& text);

}  // namespace ulpgate::kernel_test
