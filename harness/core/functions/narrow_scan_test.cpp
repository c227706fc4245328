// Tests of the stratum `narrow`: no gap is wide, suspicion knows an error from a bound, a narrow bug is
// named.
#include "harness/core/functions/narrow_scan.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "harness/core/functions/subject_call.hpp"
#include "harness/core/plan/plan.hpp"
#include "harness/core/subject/registry.hpp"

namespace ulpgate {
namespace {

const FunctionInfo& named(const char* name) {
  return info_of(find_function(name)->id);
}

template <class Real>
std::vector<Real> points(const char* name, std::size_t count) {
  std::vector<Real> out(count * static_cast<std::size_t>(named(name).arity));
  NarrowArguments<Real>(named(name), 1).fill(0, count, out.data());
  return out;
}

TEST(NarrowArguments, LeaveNoWideGapInAnyBinade) {
  constexpr std::size_t count = 1U << 20U;
  auto all = points<double>("sin", count);
  std::ranges::sort(all);
  // Binades, the share of the circle that their band has, and the signed binades of that band.
  struct Case {
    double low;
    double share;
    double binades;
  };
  for (const Case& c : {Case{1, 0.5, 18}, Case{-64, 0.5, 18}, Case{0x1p-20, 0.25, 124},
                        Case{0x1p28, 0.25, 124}, Case{0x1p-900, 0.25, 4196}, Case{-0x1p1000, 0.25, 4196}}) {
    const double first = std::min(c.low, c.low * 2);
    const double last = std::max(c.low, c.low * 2);
    const double widest = 3.0 / count / c.share * c.binades * std::fabs(c.low);
    double before = first;
    for (auto it = std::ranges::lower_bound(all, first); it != all.end() && before < last; ++it) {
      EXPECT_LE(std::min(*it, last) - before, widest) << c.low;
      before = *it;
    }
    EXPECT_GE(before, last - widest) << c.low;
  }
}

TEST(NarrowArguments, StayInTheDomain) {
  constexpr std::size_t count = 4096;
  for (const double x : points<double>("asin", count)) EXPECT_LT(std::fabs(x), 1);
  for (const double x : points<double>("log", count)) EXPECT_TRUE(x > 0 && std::isfinite(x));
  for (const double x : points<double>("acosh", count)) EXPECT_TRUE(x >= 1 && std::isfinite(x));
  for (const double x : points<double>("log1p", count)) EXPECT_GT(x, -1);
  bool subnormal = false;
  for (const float x : points<float>("sin", count))
    subnormal = subnormal || std::fpclassify(x) == FP_SUBNORMAL;
  EXPECT_TRUE(subnormal);
  const auto powers = points<double>("pow", count);
  int ordinary = 0;
  for (std::size_t i = 0; i < powers.size(); i += 2) {
    const double y = std::pow(powers[i], powers[i + 1]);
    ordinary += std::isnormal(y) && y != 1 ? 1 : 0;
  }
  EXPECT_GT(ordinary, static_cast<int>(count / 2)) << "of powers that are neither 1 nor out of range";
}

TEST(NarrowScan, SuspicionIsTheErrorLessTheBound) {
  if constexpr (has_narrow_scan<double>) {
    using Scan = NarrowScan<double>;
    EXPECT_DOUBLE_EQ(Scan::suspicion(1 + 0x1.8p-51, 1.0L, 0), 3);
    EXPECT_DOUBLE_EQ(Scan::suspicion(1 + 0x1.8p-51, 1.0L, 2048), 2);
    EXPECT_DOUBLE_EQ(Scan::suspicion(0x1p1023, 0x1p1023L + 0x1p971L, 0), 1) << "no intermediate overflows";
    EXPECT_DOUBLE_EQ(Scan::suspicion(0x3p-1074, 0x1p-1074L, 0), 2);
    EXPECT_EQ(Scan::suspicion(NAN, 1.0L, 1), HUGE_VAL);
    EXPECT_EQ(Scan::suspicion(1, NAN, 1), HUGE_VAL);
    EXPECT_EQ(Scan::suspicion(NAN, NAN, 1), 0);
    EXPECT_EQ(Scan::suspicion(HUGE_VAL, 0x1p1024L, 1), 0);
    EXPECT_EQ(Scan::suspicion(-HUGE_VAL, 0x1p1024L, 1), HUGE_VAL);
    EXPECT_EQ(Scan::suspicion(HUGE_VAL, 1.0L, 1), HUGE_VAL);
    EXPECT_EQ(Scan::suspicion(-0.0, 0.0L, 1), HUGE_VAL);
    EXPECT_LT(Scan::suspicion(2, 1.0L, -1), 0) << "nothing is known";
  }
}

void sin_with_a_step(const double* args, double* results, std::uint8_t* threw, std::size_t count) {
  call_of<double> (*find_subject("sin", "double"))(args, results, threw, count);
  for (std::size_t i = 0; i < count; ++i) {
    if (args[i] >= 2.5 && args[i] < 2.50025) results[i] += 3 * 0x1p-53;
  }
}

TEST(NarrowScan, A16NamesABugOfRelativeWidth1e4) {
  if constexpr (has_narrow_scan<double>) {
    NarrowScan<double> scan(named("sin"), &sin_with_a_step, 1);
    int found = 0;
    for (std::uint64_t k = 0; k < 64; ++k) {
      double x = 0;
      scan.choose(k, &x);
      found += x >= 2.5 && x < 2.50025 ? 1 : 0;
    }
    double first = 0;
    double again = 0;
    scan.choose(3, &first);
    NarrowScan<double>(named("sin"), &sin_with_a_step, 1).choose(3, &again);
    EXPECT_EQ(first, again) << "a block's choice depends on the block alone";
    EXPECT_GT(found, 0);
  }
}

int points_until_one_throws = -1;
void sqrt_that_throws_once(const double* args, double* results, std::uint8_t* threw, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    results[i] = std::sqrt(args[i]);
    if (points_until_one_throws-- == 0) threw[i] = 1;
  }
}

TEST(NarrowScan, WhatThrewInOneBlockIsForgottenInTheNext) {
  if constexpr (has_narrow_scan<double>) {
    double args[6] = {};
    NarrowArguments<double>(named("sqrt"), 1).fill(0, 6, args);
    NarrowScan<double> scan(named("sqrt"), &sqrt_that_throws_once, 1);
    points_until_one_throws = 5;
    double x = 0;
    scan.choose(0, &x);
    EXPECT_EQ(x, args[5]) << "nothing is more suspicious than what throws";
    scan.choose(1, &x);
    double want = 0;
    NarrowScan<double>(named("sqrt"), &sqrt_that_throws_once, 1).choose(1, &want);
    EXPECT_EQ(x, want);
  }
}

TEST(NarrowScan, RowsAreOfRealFunctionsOfFloatAndDouble) {
  PlanRequest request;
  request.subjects = {"sin", "pow", "csin"};
  // Of the types of wider formats one that every build has.
  request.types = {"float", "double", "mpfr62"};
  request.strata = {Stratum::narrow};
  request.samples = 20000;
  const Plan plan(request, {});
  for (const auto& row : plan.rows()) {
    EXPECT_EQ(row.source.count, 1250U);
    EXPECT_GE(row.subject->narrow_arguments() * row.source.count, 600000U) << row.subject->name();
  }
  EXPECT_EQ(plan.rows().size(), has_narrow_scan<double> ? 4U : 2U);
}

}  // namespace
}  // namespace ulpgate
