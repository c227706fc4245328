// Tests of the scans: what they settle, NativeStage settles too, and both count it alike.
// Tests of the tally: large errors, when it asks for a condition number, and what stages may say to it.
#include "harness/core/stages/ordinary_scan.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <random>

#include "harness/core/judging/row_tally.hpp"
#include "harness/core/judging/screened_judging.hpp"
#include "harness/core/judging/tally.hpp"
#include "harness/core/records/recorded_figures.hpp"
#include "harness/core/stages/exact_results.hpp"
#include "harness/core/stages/native_stage.hpp"
#include "kernels/math/function_table.hpp"

namespace ulpgate {
namespace {

// Bit patterns of every kind, plateaus where a result stays at 0, 1, 2 or its argument among them.
std::vector<float> many_floats() {
  std::mt19937 words(7);
  std::vector<float> list;
  list.reserve(50000);
  for (int i = 0; i < 30000; ++i) list.push_back(std::bit_cast<float>(static_cast<std::uint32_t>(words())));
  for (int i = -4000; i <= 4000; ++i) {
    list.push_back(static_cast<float>(i) * 0.0625F);
    list.push_back(std::ldexp(1.0F + static_cast<float>(i) * 0x1p-23F, i % 140));
  }
  return list;
}

template <class Native, class Real>
void count_one_by_one(const Native& stage, const std::vector<Real>& args, const std::vector<Real>& results,
                      const std::vector<std::uint8_t>& verdicts, RowTally<Real>& tally,
                      std::uint64_t first = 0) {
  const std::size_t arity = args.size() / results.size();
  for (std::size_t i = 0; i < results.size(); ++i) {
    if (verdicts[i] == verdict::unsettled) continue;
    Finding finding;
    const Real* point = &args[i * arity];
    ASSERT_TRUE(stage.find(i, 0, point, results[i], finding)) << *point;
    const long double value = stage.value(i, 0);
    ASSERT_TRUE(tally.settle({&finding, 1}, first + i, point, {&value, 1})) << *point;
  }
}

// A tally that has met the largest error and a large distance: errors above 1/2 ULP are settled then, too.
template <class Real>
RowTally<Real> experienced_tally(const FunctionInfo& f, RowHint& hint, const std::vector<Real>& args,
                                 double largest) {
  RowTally<Real> tally(f, hint);
  const Finding far{Outcome::finite, largest, largest, 10, true, false};
  const long double value = 1;
  EXPECT_TRUE(tally.settle({&far, 1}, 0, args.data(), {&value, 1}));
  return tally;
}

// Every third result is some neighbours off.
template <class Real>
void make_wrong(std::vector<Real>& results) {
  for (std::size_t i = 0; i < results.size(); i += 3) {
    for (std::size_t steps = 0; steps < 1 + i / 3 % 5; ++steps)
      results[i] = std::nextafter(results[i], i % 2 == 0 ? HUGE_VALF : -HUGE_VALF);
  }
}

// Bit patterns of every kind, and what functions are mostly asked for.
std::vector<double> many_doubles(std::size_t count) {
  std::mt19937_64 words(11);
  std::vector<double> list;
  list.reserve(count);
  while (list.size() < count) {
    list.push_back(std::bit_cast<double>(words()));
    const double small = static_cast<double>(words() >> 11U) * 0x1p-53;
    for (const double x : {small, 200 * small - 100, std::floor(64 * small), 1 + std::ldexp(small, -40)})
      if (list.size() < count) list.push_back(x);
  }
  return list;
}

// How many samples one of two scans settled and the other did not; what both did is the same.
std::size_t differently_settled(const std::vector<std::uint8_t>& a, const std::vector<std::uint8_t>& b) {
  std::size_t unsettled = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (a[i] == b[i]) continue;
    ++unsettled;
    EXPECT_TRUE(a[i] == verdict::unsettled || b[i] == verdict::unsettled) << i;
  }
  return unsettled;
}

TEST(OrdinaryScan, SettlesNothingThatTheStageWouldNotAndCountsItAlike) {
  const std::vector<float> args = many_floats();
  const FunctionTable<float>& functions = function_table<float>();
  for (const FunctionInfo& f : all_functions()) {
    const ScreenStages stages = screen_stages(f);
    if (f.arity != 1 || stages.binary64 == nullptr) continue;
    std::vector<float> results(args.size());
    std::vector<std::uint8_t> threw(args.size());
    functions[static_cast<std::size_t>(f.id)](args.data(), results.data(), threw.data(), args.size());
    NativeStage<float, double, Stage::binary64> stage(f.id, stages.binary64);
    stage.load(args, args.size());
    make_wrong(results);
    std::uint64_t large = 0;
    for (const double largest : {0.3, 5.0}) {
      for (const OrdinaryScan scan : ordinary_scans()) {
        RowHint hint(1);
        hint.raise_max_error(0, {largest, 0});
        hint.raise_error_over_condition(0, 100);
        auto at_once = experienced_tally<float>(f, hint, args, largest);
        auto one_by_one = experienced_tally<float>(f, hint, args, largest);
        std::vector<std::uint8_t> verdicts(args.size());
        scan(stage.scan_input(args, results, 0, at_once.scan_limits(0)), verdicts.data());
        at_once.count_scanned(verdicts, 0);
        count_one_by_one(stage, args, results, verdicts, one_by_one);
        const Summary a = at_once.take()[0];
        const Summary b = one_by_one.take()[0];
        EXPECT_EQ(recorded_figures(a), recorded_figures(b)) << f.name;
        const double settled = static_cast<double>(a.samples) / static_cast<double>(args.size());
        EXPECT_GT(settled, largest > 1 ? 0.4 : 0.1) << f.name;
        if (largest > 1) large += a.samples - a.correctly_rounded;
      }
    }
    EXPECT_GT(large, args.size() / 40) << f.name << ": errors above 1/2 ULP";
  }
}

TEST(WideScan, SettlesNothingThatTheStageWouldNotAndCountsItAlike) {
  const FunctionTable<double>& functions = function_table<double>();
  int scanned = 0;
  for (const FunctionInfo& f : all_functions()) {
    const ScreenStages stages = screen_stages(f);
    // Neither parts nor what is of whole numbers is scanned here.
    if (stages.double_double == nullptr || f.parts != 1 || f.function_class == FunctionClass::special)
      continue;
    ++scanned;
    constexpr std::size_t count = 20000;
    const std::vector<double> args = many_doubles(count * static_cast<std::size_t>(f.arity));
    std::vector<double> results(count);
    std::vector<std::uint8_t> threw(count);
    functions[static_cast<std::size_t>(f.id)](args.data(), results.data(), threw.data(), count);
    // Wrong results of every size, zeros, infinities and NaN are settled alike, too.
    for (std::size_t i = 0; i < count; i += 7) {
      const double x = results[i];
      const double wrong[] = {
          std::nextafter(x, 9), std::nextafter(x, -9), -x, x * 3, 0, -0.0, 1 / 0.0, 0.0 / 0.0};
      results[i] = wrong[i / 7 % 8];
    }
    make_wrong(results);
    NativeStage<double, DoubleDouble, Stage::double_double> stage(f.id, stages.double_double);
    stage.load(args, count);
    std::vector<std::vector<std::uint8_t>> all;
    for (const WideScan scan : wide_scans()) {
      std::vector<std::uint8_t> verdicts(count);
      // Of 1/2 ULP, a tie is no new maximum.
      for (const double largest : {5.0, 0.5, 0.3}) {
        RowHint hint(1);
        hint.raise_max_error(0, {largest, 0});
        hint.raise_error_over_condition(0, 100);
        auto at_once = experienced_tally<double>(f, hint, args, largest);
        auto one_by_one = experienced_tally<double>(f, hint, args, largest);
        scan(stage.scan_input(args, results, 77, at_once.scan_limits(77)), verdicts.data());
        at_once.count_scanned(verdicts, 77);
        count_one_by_one(stage, args, results, verdicts, one_by_one, 77);
        const Summary a = at_once.take()[0];
        EXPECT_EQ(recorded_figures(a), recorded_figures(one_by_one.take()[0])) << f.name;
        EXPECT_GT(static_cast<double>(a.samples), (largest > 1 ? 0.2 : 0.05) * count) << f.name;
      }
      scan(stage.scan_input(args, results, 77, {5.0, 100, 10}), verdicts.data());
      verdicts.resize(count - 8);
      all.push_back(verdicts);
      // Wrong by whole steps where errors are tiny, many are next to an edge.
      EXPECT_LT(differently_settled(all.front(), all.back()), count / 10) << f.name;
    }
  }
  EXPECT_GE(scanned, 28);
}

TEST(OrdinaryScan, WritesTheSameVerdictsWithEveryInstructionSet) {
  const std::vector<float> args = many_floats();
  NativeStage<float, double, Stage::binary64> stage(FunctionId::tanh,
                                                    bounded_function<double>(FunctionId::tanh));
  stage.load(args, args.size());
  std::vector<float> results;
  results.reserve(args.size());
  for (const float x : args) results.push_back(std::tanh(x));
  std::vector<std::vector<std::uint8_t>> all;
  for (const OrdinaryScan scan : ordinary_scans()) {
    all.emplace_back(args.size());
    scan(stage.scan_input(args, results, 123456789, {1.5, 0.9, 1}), all.back().data());
    all.back().resize(args.size() - 16);
    EXPECT_LT(differently_settled(all.front(), all.back()), args.size() / 1000);
  }
}

Judgement off_by(double error) {
  return {Outcome::finite, {error}, std::ceil(error), error <= 0.5};
}

TEST(Tally, CountsErrorsOfEverySizeAsASummaryDoes) {
  Tally tally({});
  Summary want;
  std::uint64_t k = 0;
  for (const double error :
       {0.0, 0x1p-10, 0.25, 0.5, 0.75, 3.0, 1000.0, 1024.0, 1025.0, 5000.5, 0x1p30, 0x1p52}) {
    for (int times = 0; times < 3; ++times, ++k) {
      tally.count(finding_of(off_by(error)), k);
      want.add(off_by(error), k);
    }
  }
  EXPECT_EQ(recorded_figures(tally.take()), recorded_figures(want));
}

// The condition number itself costs several references: it is asked for where error / condition may be the
// largest so far, by a lower bound of the condition number.
TEST(Tally, AsksForAConditionNumberWhereItMayRaiseTheRatio) {
  Tally tally({100, 0});
  const auto need = [&](double error, double ratio_seen, double bound) {
    return tally.need(finding_of(off_by(error)), 1, ratio_seen, [&] { return bound; });
  };
  EXPECT_EQ(need(12, 2, 5), Need::condition) << "at most 12/5";
  EXPECT_EQ(need(12, 2, 6), Need::condition) << "the same ratio once more";
  EXPECT_EQ(need(12, 2, 7), Need::nothing) << "below 12/7";
  EXPECT_EQ(need(1.5, 2, 1), Need::nothing);
  EXPECT_EQ(need(0.5, 0, 1), Need::nothing) << "correctly rounded";
  Finding vague = finding_of(off_by(12));
  vague.least = 11.9999;
  EXPECT_EQ(tally.need(vague, 1, 2, [] { return 5.0; }), Need::better) << "the error must be known first";
  EXPECT_EQ(tally.need(vague, 1, 2, [] { return 7.0; }), Need::nothing);
}

// e^-20 is small, and the bound must be that of the argument itself: by e^0 the condition number would seem
// to be 2^28 times as large, and the largest error over condition would be passed over.
TEST(RowTally, BoundsTheConditionNumberAtTheSampleItself) {
  const FunctionInfo& f = info_of(FunctionId::cexp);
  const std::array<float, 2> args = {-20, 0.5F};
  const std::array<long double, 2> values = {std::exp(-20.0L) * std::cos(0.5L),
                                             std::exp(-20.0L) * std::sin(0.5L)};
  RowHint hint(2);
  hint.raise_error_over_condition(0, 1);
  RowTally<float> tally(f, hint);
  const std::array<Finding, 2> findings = {finding_of(off_by(41)), finding_of(off_by(0.25))};
  EXPECT_TRUE(tally.settle(findings, 0, args.data(), values));
  // |x| + |y tan y| of the real part.
  const double condition = 20 + 0.5 * std::tan(0.5);
  EXPECT_NEAR(tally.take()[0].max_error_over_condition, 41 / condition, 1e-9);
}

// Infinity for e^80, which binary32 holds: no stage may take it for an agreed one.
TEST(NativeStage, DoesNotAgreeToASpuriousOverflow) {
  const std::vector<float> args = {80, 89, 100};
  NativeStage<float, double, Stage::binary64> stage(FunctionId::exp,
                                                    bounded_function<double>(FunctionId::exp));
  stage.load(args, args.size());
  Finding finding;
  constexpr float infinity = std::numeric_limits<float>::infinity();
  EXPECT_FALSE(stage.find(0, 0, &args[0], infinity, finding));
  EXPECT_TRUE(stage.find(2, 0, &args[2], infinity, finding)) << "beyond the range";
  EXPECT_EQ(finding.outcome, Outcome::finite);
}

// The stage's zero stands for e^-701, a normal double, which is 2^-862 ULP of binary32 off.
TEST(NativeStage, KnowsHowMuchAZeroMayBeOff) {
  const std::vector<float> args = {-701};
  NativeStage<float, double, Stage::binary64> stage(FunctionId::exp,
                                                    bounded_function<double>(FunctionId::exp));
  stage.load(args, args.size());
  Finding finding;
  ASSERT_TRUE(stage.find(0, 0, args.data(), 0.0F, finding));
  EXPECT_GT(finding.least, 0);
  EXPECT_GE(finding.greatest, std::ldexp(std::exp(-701.0), 149));
  EXPECT_LT(finding.greatest, 0x1p-600);
}

// What is lost of a product or a quotient may be below the least number and seem to be nothing.
TEST(ExactResults, ArePassedOverWhereTheResidualUnderflows) {
  const double x = 1 + 0x1p-52;
  for (const double scale : {0x1p-500, 0x1p-505, 0x1p-510}) {
    const double product[] = {x * scale, x * scale};
    EXPECT_NE(exactness_of(FunctionId::mul, product, product[0] * product[1]), Exactness::exact) << scale;
    const double quotient[] = {scale * scale, x * 3 * scale};
    EXPECT_NE(exactness_of(FunctionId::div, quotient, quotient[0] / quotient[1]), Exactness::exact) << scale;
  }
  const double plain[] = {x, x};
  EXPECT_EQ(exactness_of(FunctionId::mul, plain, x * x), Exactness::rounded);
  const double whole[] = {3, 5};
  EXPECT_EQ(exactness_of(FunctionId::mul, whole, 15.0), Exactness::exact);
}

// By the place of the last bit: L_2^3(x) = 10 - 5x + x^2/2.
TEST(ExactResults, OfLaguerrePolynomialsAreToldByTheirLastBit) {
  const double half[] = {2, 3, 0.5};
  EXPECT_EQ(exactness_of(FunctionId::laguerre, half, 7.625), Exactness::unknown) << "it may be: it is";
  EXPECT_EQ(exactness_of(FunctionId::laguerre, half, 7.5), Exactness::rounded);
  EXPECT_EQ(exactness_of(FunctionId::laguerre, half, 7.5625), Exactness::rounded);
  const double small[] = {2, 3, 0x1p-400};
  EXPECT_EQ(exactness_of(FunctionId::laguerre, small, 10.0), Exactness::rounded);
  const double whole[] = {2, 3, 4};
  EXPECT_EQ(exactness_of(FunctionId::laguerre, whole, -2.0), Exactness::unknown);
  const long double wide[] = {2, 3, 0x1.8p-1L};
  EXPECT_EQ(exactness_of(FunctionId::laguerre, wide, 0x1p-5L), Exactness::unknown) << "9/32 is the last term";
  EXPECT_EQ(exactness_of(FunctionId::laguerre, wide, 0x1p-62L), Exactness::rounded);
}

// 87 - x to 111 bits is 2^-104 off, a ninth of x.
TEST(NativeStage, AllowsForWhatTheFullReferenceIsOffBy) {
  const FunctionInfo& f = info_of(FunctionId::laguerre);
  const float args[] = {1, 86, 0x1.ca91f6p-105F};
  const float result = 87;
  const std::uint8_t threw = 0;
  FullJudging<float> full(f);
  const Batch<float> batch{f, args, {&result, 1}, {&threw, 1}};
  full.load(batch, 0);
  NativeStage<float, DoubleDouble, Stage::double_double> stage(f.id, double_double_function(f.id));
  stage.load(args, 1);
  Finding finding;
  ASSERT_TRUE(stage.find(0, 0, args, result, finding));
  EXPECT_TRUE(finding.allows(full.judgement(batch, 0, 0)));
}

// A library that has no value where there is one: no better reference is asked.
TEST(NativeStage, TellsNanForAValue) {
  const std::vector<double> args = {60, 40, 0x1p900, 2, 3, 0.5};
  NativeStage<double, DoubleDouble, Stage::double_double> stage(FunctionId::laguerre,
                                                                double_double_function(FunctionId::laguerre));
  stage.load(args, 2);
  for (std::size_t i = 0; i < 2; ++i) {
    Finding finding;
    ASSERT_TRUE(stage.find(i, 0, &args[3 * i], std::nan(""), finding)) << i;
    EXPECT_EQ(finding.outcome, Outcome::nan);
  }
  Finding finding;
  ASSERT_TRUE(stage.find(0, 0, args.data(), HUGE_VAL, finding));
  EXPECT_EQ(finding.outcome, Outcome::finite);
}

}  // namespace
}  // namespace ulpgate
