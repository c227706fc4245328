// Tests of the screened reference: the records of the full one, and a lying stage is found.
#include "harness/core/judging/screened_judging.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "harness/core/records/recorded_figures.hpp"
#include "harness/core/subject/registry.hpp"
#include "kernels/math/function_table.hpp"

namespace ulpgate {
namespace {

TEST(ScreenedJudging, GivesTheRecordsOfTheFullReference) {
  for (const auto& subject : all_subjects()) {
    if (subject->info().kind != SubjectKind::function) continue;
    const ArgumentList edges = subject->listed(Stratum::edges);
    for (const StratumSource& source :
         {StratumSource{Stratum::uniform, 7, 40, nullptr}, StratumSource{Stratum::binades, 7, 20, nullptr},
          StratumSource{Stratum::edges, 7, std::min<std::uint64_t>(edges.size(), 100), &edges}}) {
      RowHint hint(subject->info().parts.size());
      RowHint other_hint(subject->info().parts.size());
      const auto full = subject->evaluate(source, 0, source.count, ReferenceMode::full, hint);
      const auto screened = subject->evaluate(source, 0, source.count, ReferenceMode::screened, other_hint);
      for (std::size_t part = 0; part < full.size(); ++part) {
        EXPECT_EQ(recorded_figures(full[part]), recorded_figures(screened[part]))
            << subject->name() << " part " << part << " " << subject->type().token << " "
            << name_of(source.stratum);
      }
    }
  }
}

// Four in five points have an erf that is -1 or 1 to more bits than the MPFR stage has: their tiny errors tie
// for the maximum until a preview has found a larger one.
TEST(ScreenedJudging, APlateauOfTinyErrorsDoesNotClimb) {
  const Subject* erf = find_subject("erf", "mpfr62");
  if (erf == nullptr) GTEST_SKIP() << "no mpfr62 in this build";
  const StratumSource source{Stratum::stratified, 1, 2000, nullptr};
  RowHint hint(1);
  static_cast<void>(erf->evaluate(source, 0, source.count, ReferenceMode::screened, hint));
  EXPECT_GE(hint.decided[static_cast<std::size_t>(Stage::mpfr)], 1950U);
}

#ifdef ULPGATE_HAVE_FLOAT128
// A stratified row is sorted: in its last units erf is 1 to more bits than double-double has, and only
// another unit has an error that is larger than what these may have.
TEST(ScreenedJudging, APlateauOfAWholeUnitDoesNotClimb) {
  constexpr std::uint64_t count = std::uint64_t{1} << 20U;
  constexpr std::uint64_t unit = 2048;
  constexpr auto binary128 = static_cast<std::size_t>(Stage::binary128);
  const Subject* erf = find_subject("erf", "long_double");
  if (erf == nullptr || std::numeric_limits<long double>::digits != 64)
    GTEST_SKIP() << "no long double of x87 in this build";
  const StratumSource source{Stratum::stratified, 1, count, nullptr};
  RowHint alone(1);
  const auto without = erf->evaluate(source, count - unit, count, ReferenceMode::screened, alone);
  // The run holds the row's middle as well.
  RowHint hint(1, {{count / 2 - unit, count / 2 + unit}, {count - unit, count}});
  const auto with = erf->evaluate(source, count - unit, count, ReferenceMode::screened, hint);
  EXPECT_GT(alone.decided[binary128], unit / 2) << "a unit that is no plateau shows nothing";
  EXPECT_LT(hint.decided[binary128], unit / 100);
  EXPECT_EQ(with[0].samples, without[0].samples);
}
#endif

// Off by a thousand units of its own precision, and told as exact, so that the lie decides.
ExactParts lying_mpfr(const FunctionInfo& f, std::span<const MpfrValue> args, std::span<MpfrValue> out) {
  exact_value(f, args, out);
  for (int step = 0; step < 1000; ++step) mpfr_nextabove(out[0]);
  return {Exactness::exact, Exactness::exact};
}

// Off by 2^-16 of the value, with a bound of half an ulp.
template <class W>
void lying_exp(const W* args, W* results, double* bounds, std::size_t count, int argument_bits) {
  bounded_function<W>(FunctionId::exp)(args, results, bounds, count, argument_bits);
  for (std::size_t i = 0; i < count; ++i) {
    results[i] += results[i] / 65536;
    bounds[i] = 0.5;
  }
}

void lying_double_double(const DoubleDouble* args, DoubleDouble* results, double* bounds, std::size_t count,
                         int argument_bits) {
  double_double_function(FunctionId::exp)(args, results, bounds, count, argument_bits);
  for (std::size_t i = 0; i < count; ++i) {
    results[i].hi += results[i].hi / 65536;
    bounds[i] = 0.5;
  }
}

#ifdef ULPGATE_HAVE_FLOAT128
void lying_triple_double(const TripleDouble* args, TripleDouble* results, double* scales, double* bounds,
                         std::size_t count) {
  triple_double_function(FunctionId::exp)(args, results, scales, bounds, count);
  for (std::size_t i = 0; i < count; ++i) {
    results[i].hi += results[i].hi / 65536;
    bounds[i] = 0.5;
  }
}
#endif

// Judges exp(0.5) as the point with this index.
template <class Real>
void judge_exp(const ScreenStages& stages, std::uint64_t index) {
  using std::exp;
  const FunctionInfo& info = info_of(FunctionId::exp);
  const Real x = 0.5;
  const Real y = exp(x);
  const std::uint8_t threw = 0;
  RowHint hint(1);
  RowTally<Real> tally(info, hint);
  ScreenedJudging<Real> judging(info, stages);
  judging.judge({info, {&x, 1}, {&y, 1}, {&threw, 1}, index}, tally);
}

template <class Real>
void expect_named(const ScreenStages& stages, std::string_view stage,
                  std::uint64_t checked = ScreenedJudging<Real>::deep_check_stride) {
  // Index 1 is not among the checked: there the lie passes, whatever it decides.
  EXPECT_NO_THROW(judge_exp<Real>(stages, 1)) << stage;
  try {
    judge_exp<Real>(stages, checked);
    FAIL() << "the checked share must find the lie of " << stage;
  } catch (const ReferenceDisagreement& e) {
    EXPECT_NE(std::string(e.what()).find(stage), std::string::npos) << e.what();
    EXPECT_NE(std::string(e.what()).find("exp at 0x1p-1"), std::string::npos) << e.what();
  }
}

TEST(ScreenedJudging, ALyingStageIsFoundAndTheArgumentNamed) {
  const FunctionInfo& exp = info_of(FunctionId::exp);
  EXPECT_NO_THROW(judge_exp<double>(screen_stages(exp), 0)) << "the stages as they are";
  ScreenStages stages = screen_stages(exp);
  stages.mpfr = lying_mpfr;
  expect_named<double>(stages, "mpfr");
  stages = screen_stages(exp);
  stages.binary64 = lying_exp<double>;
  expect_named<float>(stages, "binary64");
  // Every checked sample holds the first stage that says anything of it to its bound.
  expect_named<float>(stages, "binary64", ScreenedJudging<float>::check_stride);
  stages = screen_stages(exp);
  stages.double_double = lying_double_double;
  expect_named<double>(stages, "double_double");
  expect_named<double>(stages, "double_double", ScreenedJudging<double>::check_stride);
  if constexpr (NativeBits<long double>) {
    stages = screen_stages(exp);
    stages.double_double = nullptr;
    stages.x87_extended = lying_exp<long double>;
    expect_named<double>(stages, "x87_extended");
    expect_named<double>(stages, "x87_extended", ScreenedJudging<double>::check_stride);
  }
#ifdef ULPGATE_HAVE_FLOAT128
  stages = screen_stages(exp);
  stages.binary128 = lying_exp<Binary128>;
  expect_named<double>(stages, "binary128");
  expect_named<long double>(stages, "binary128");
  stages = screen_stages(exp);
  stages.triple_double = lying_triple_double;
  expect_named<Float128Real>(stages, "triple_double");
  expect_named<Float128Real>(stages, "triple_double", ScreenedJudging<Float128Real>::check_stride);
  // Narrower types are checked by it, and it by the full reference.
  expect_named<float>(stages, "disagrees with the triple_double", ScreenedJudging<float>::check_stride);
  expect_named<double>(stages, "disagrees with the triple_double", ScreenedJudging<double>::check_stride);
  expect_named<long double>(stages, "disagrees with the triple_double",
                            ScreenedJudging<long double>::check_stride);
  expect_named<double>(stages, "(triple_double) disagrees with the full");
#endif
}

TEST(ScreenedJudging, CheapStagesDecideNearlyEverySample) {
  RowHint hint(1);
  const auto summaries =
      find_subject("exp", "double")
          ->evaluate({Stratum::uniform, 1, 20000, nullptr}, 0, 20000, ReferenceMode::screened, hint);
  std::uint64_t all = 0;
  for (const auto& n : hint.decided) all += n;
  EXPECT_EQ(all, 20000U);
  EXPECT_EQ(summaries[0].samples, 20000U);
  EXPECT_GT(hint.decided[static_cast<std::size_t>(Stage::double_double)], 19900U);
  EXPECT_LT(hint.decided[static_cast<std::size_t>(Stage::mpfr)], 20U);
}

TEST(ScreenedJudging, DoubleDoubleDecidesNearlyEverySampleOfComplexFunctions) {
  for (const char* type : {"float", "double", "long_double"}) {
    if (find_type(type) == nullptr) continue;
    for (const FunctionInfo& f : all_functions()) {
      if (f.function_class != FunctionClass::complex) continue;
      RowHint hint(static_cast<std::size_t>(f.parts));
      static_cast<void>(
          find_subject(f.name, type)
              ->evaluate({Stratum::uniform, 1, 2000, nullptr}, 0, 2000, ReferenceMode::screened, hint));
      // A power's angle may be too vague.
      const std::uint64_t most = f.id == FunctionId::cpow ? 1500 : 1800;
      EXPECT_GT(hint.decided[static_cast<std::size_t>(Stage::double_double)], most) << f.name << ' ' << type;
    }
  }
}

#ifdef ULPGATE_HAVE_FLOAT128
// A checked sample that triple-double knows costs no full reference.
TEST(ScreenedJudging, TripleDoubleChecksNarrowerTypes) {
  constexpr std::uint64_t count = 64 * ScreenedJudging<double>::check_stride;
  constexpr std::uint64_t deep = count / ScreenedJudging<double>::deep_check_stride;
  for (const char* name : {"mul", "exp", "sin", "atan2", "tanh", "erf", "lgamma"}) {
    for (const char* type : {"float", "double", "long_double"}) {
      const Subject* subject = find_subject(name, type);
      if (subject == nullptr) continue;
      RowHint hint(1);
      static_cast<void>(
          subject->evaluate({Stratum::uniform, 1, count, nullptr}, 0, count, ReferenceMode::screened, hint));
      EXPECT_GE(hint.decided[static_cast<std::size_t>(Stage::full)], deep) << name << ' ' << type;
      EXPECT_LE(hint.decided[static_cast<std::size_t>(Stage::full)], deep + 20) << name << ' ' << type;
    }
  }
}

TEST(ScreenedJudging, TripleDoubleDecidesNearlyEverySampleOfFloat128) {
  if (find_subject("exp", "float128") == nullptr) GTEST_SKIP() << "float128 is not built";
  for (const char* name : {"add", "mul", "exp", "log", "sin", "atan2", "tanh", "erf", "lgamma"}) {
    RowHint hint(1);
    const auto* subject = find_subject(name, "float128");
    const auto summaries =
        subject->evaluate({Stratum::uniform, 1, 4000, nullptr}, 0, 4000, ReferenceMode::screened, hint);
    EXPECT_EQ(summaries[0].samples, 4000U);
    EXPECT_GT(hint.decided[static_cast<std::size_t>(Stage::triple_double)], 3800U) << name;
  }
}
#endif

// Arguments whose results leave the range, ordinary ones first: where nothing is known yet, each could be a
// maximum.
template <class Real>
struct RangeEnd {
  FunctionId id;
  Real first, last;
  // As of a library that knows no signs of zeros.
  bool zeros_are_positive = false;
};

template <class Real>
void expect_no_mpfr(const std::vector<RangeEnd<Real>>& ends) {
  const FunctionTable<Real>& functions = function_table<Real>();
  constexpr std::size_t count = 2000;
  for (const auto& [id, first, last, zeros_are_positive] : ends) {
    const FunctionInfo& f = info_of(id);
    std::vector<Real> args(count);
    std::vector<Real> results(count);
    std::vector<std::uint8_t> threw(count);
    for (std::size_t i = 0; i < count; ++i)
      args[i] = first + (last - first) * (static_cast<Real>(i) / static_cast<Real>(count));
    functions[static_cast<std::size_t>(id)](args.data(), results.data(), threw.data(), count);
    for (Real& y : results)
      if (zeros_are_positive && y == 0) y = 0;
    const Batch<Real> batch{f, args, results, threw, 1};
    RowHint hint(1);
    RowTally<Real> full_tally(f, hint);
    FullJudging<Real>(f).judge(batch, full_tally);
    RowTally<Real> tally(f, hint);
    ScreenedJudging<Real> judging(f);
    judging.judge(batch, tally);
    EXPECT_EQ(recorded_figures(tally.take()[0]), recorded_figures(full_tally.take()[0])) << f.name;
    EXPECT_LT(judging.decided()[static_cast<std::size_t>(Stage::mpfr)], count / 50) << f.name << " " << first;
  }
}

// The double stage says what becomes of them: exact values down to half of the least subnormal and up to the
// largest number, and beyond.
TEST(ScreenedJudging, FloatNextToTheEndsOfItsRangeNeedsNoMpfr) {
  expect_no_mpfr<float>({
      {FunctionId::erfc, 9, 11},
      {FunctionId::tgamma, -43.9F, -38.1F},
      {FunctionId::tgamma, -43.9F, -38.1F, true},
      {FunctionId::tgamma, -1000.9F, -900.1F, true},
      {FunctionId::tgamma, 34, 36},
      {FunctionId::tgamma, 0x1p-129F, 0x1p-126F},
      {FunctionId::lgamma, 0x1p119F, 0x1p123F},
      {FunctionId::exp, 87, 90},
      {FunctionId::exp, -105, -86},
      {FunctionId::sinh, -91, -87},
  });
}

#ifdef ULPGATE_HAVE_FLOAT128
// Those with wider exponents do.
TEST(ScreenedJudging, DoubleNextToTheEndsOfItsRangeNeedsNoMpfr) {
  expect_no_mpfr<double>({
      {FunctionId::erfc, 24, 30},
      {FunctionId::tgamma, -170.1, -183.9},
      {FunctionId::tgamma, 169, 173},
      {FunctionId::tgamma, 0x1p-1022, 0x1p-1025},
      {FunctionId::lgamma, 0x1p1010, 0x1p1016},
      {FunctionId::exp, 690, 730},
      {FunctionId::exp, -650, -780},
      {FunctionId::exp2, -950, -1120},
      {FunctionId::expm1, 690, 730},
      {FunctionId::sinh, -690, -730},
      {FunctionId::cosh, 690, 730},
      {FunctionId::log, 0x1p-1074, 0x1p-1000},
  });
}
#endif

TEST(RecordedError, IsRoundedUpToFortyBits) {
  struct Case {
    double error;
    double want;
    const char* why;
  };
  for (const auto& [error, want, why] : {
           Case{0, 0, "an exact result stays exact"},
           Case{0.5, 0.5, "half a ULP is a multiple"},
           Case{1e-30, 0x1p-40, "no error looks exact"},
           Case{0.5 + 0x1p-50, 0.5 + 0x1p-40, "up, never down"},
           Case{0x1p60, 0x1p60, "powers of two stay"},
           Case{0x1p60 + 0x1p10, 0x1p60 + 0x1p21, "forty bits of a large error"},
           Case{HUGE_VAL, HUGE_VAL, "infinity stays"},
       }) {
    EXPECT_EQ(recorded({error}).value, want) << why;
  }
}

}  // namespace
}  // namespace ulpgate
