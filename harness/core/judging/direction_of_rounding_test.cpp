// Tests of the direction of a reference's rounding: where RealHP<4> holds a power of two or a midpoint, it
// alone tells the binade and the nearest number.
#include <gtest/gtest.h>

#include <cmath>

#include "harness/core/judging/screened_judging.hpp"
#include "harness/core/records/recorded_figures.hpp"
#include "reference/text/literal.hpp"

namespace ulpgate {
namespace {

constexpr double below_one = 0x1.fffffffffffffp-1;
constexpr double above_one = 0x1.0000000000001p+0;

struct Case {
  FunctionId id;
  std::vector<double> args;
  double got;
  double error_ulp;
  double distance;
  const char* why;
};

// Every exact value differs from a number of double, or a midpoint, by less than 4 x 53 bits show.
const std::vector<Case>& cases() {
  using enum FunctionId;
  static const std::vector<Case> list = {
      {exp, {-0x1p-300}, below_one, 1, 1, "just below 1 the spacing is 2^-53"},
      {exp, {-0x1p-300}, above_one, 2, 1, "2^-52 is two of them"},
      {exp, {-0x1p-300}, 1, 0, 0, "wrong, but by next to nothing"},
      {exp, {0x1p-300}, below_one, 0.5, 1, "just above 1 it is 2^-52"},
      {exp, {0x1p-300}, above_one, 1, 1, "one spacing"},
      {cos, {0x1p-200}, below_one, 1, 1, "1 - 2^-401"},
      {pow, {above_one, -0x1p-500}, below_one, 1, 1, "1 - 2^-552"},
      {pow, {2, -0x1p-500}, above_one, 2, 1, "1 - ln 2 2^-500"},
      {sqrt, {1}, below_one, 0.5, 1, "exactly 1: the binade above counts"},
      // The complex ones by MPC's word on each part: (1 + ie)^(+-1/2) = 1 +- ie/2 + (1/8 or -3/8) e^2.
      {cpow, {1, 0x1p-300, -0.5, 0}, below_one, 1, 1, "1 - 3/8 2^-600"},
      {cpow, {1, 0x1p-300, 0.5, 0}, below_one, 0.5, 1, "1 + 1/8 2^-600"},
      {cpow, {1, 0x1p-300, -0.5, 0}, above_one, 2, 1, "1 - 3/8 2^-600"},
      // By the sign of w log z: e^(+-2^-300 ln 2) cos(2^-400 ln 2).
      {cpow, {2, 0x1p-900, -0x1p-300, 0x1p-400}, below_one, 1, 1, "1 - ln 2 2^-300"},
      {cpow, {2, 0x1p-900, -0x1p-300, 0x1p-400}, 1, 0, 0, "wrong, but by next to nothing"},
      {cpow, {2, 0x1p-900, 0x1p-300, 0x1p-400}, below_one, 0.5, 1, "1 + ln 2 2^-300"},
      {cpow, {2, 0x1p-900, 0x1p-300, 0x1p-400}, above_one, 1, 1, "one spacing"},
      {csqrt, {1, 0x1p-300}, below_one, 0.5, 1, "1 + 1/8 2^-600"},
      {csqrt, {-1, 0x1p-300}, 0x1p-301, 0, 0, "2^-301 (1 - 1/8 2^-600): the exact value is a little less"},
      {csqrt, {-1, 0x1p-300}, 0x1.fffffffffffffp-302, 1, 1, "below 2^-301"},
      // 1 + 2^-53 is the midpoint of 1 and the next number.
      {fma, {1 + 0x1p-27, 1 - 0x1p-27, 0x1p-54 + 0x1p-53}, 1, 0.5, 0, "exactly 1 + 2^-53: even"},
      {fma, {0x1p-27 + 0x1p-30, 0, 1}, 1, 0, 0, "exact"},
  };
  return list;
}

template <class Judging>
Summary judge_one(const Case& c, std::uint64_t index) {
  const FunctionInfo& f = info_of(c.id);
  std::vector<double> results(static_cast<std::size_t>(f.parts), c.got);
  const std::uint8_t threw = 0;
  RowHint hint(static_cast<std::size_t>(f.parts));
  RowTally<double> tally(f, hint);
  Judging judging(f);
  judging.judge(Batch<double>{f, c.args, results, {&threw, 1}, index}, tally);
  return tally.take()[0];
}

// Errors of next to nothing are told as 0 here.
void expect_judged(const Case& c) {
  const FunctionInfo& f = info_of(c.id);
  const std::vector<double> results(static_cast<std::size_t>(f.parts), c.got);
  const std::uint8_t threw = 0;
  const Batch<double> batch{f, c.args, results, {&threw, 1}};
  FullJudging<double> judging(f);
  judging.load(batch, 0);
  const Judgement j = judging.judgement(batch, 0, 0);
  EXPECT_EQ(name_of(j.outcome), "finite") << f.name << ": " << c.why;
  EXPECT_NEAR(j.error.value, c.error_ulp, 0x1p-40) << f.name << ": " << c.why;
  EXPECT_EQ(j.distance, c.distance) << f.name << ": " << c.why;
}

TEST(DirectionOfRounding, TellsTheBinadeAtAPowerOfTwo) {
  for (const Case& c : cases()) expect_judged(c);
}

TEST(DirectionOfRounding, TellsTheNearestNumberAtAMidpoint) {
  struct Midpoint {
    double c;
    double got;
    bool nearest;
  };
  // a b = 1 + 2^-26 + 2^-27 + 2^-53 lies midway between two numbers; the third number decides.
  constexpr double a = 1 + 0x1p-26;
  constexpr double b = 1 + 0x1p-27;
  constexpr double even = 1 + 0x1p-26 + 0x1p-27;
  constexpr double odd = even + 0x1p-52;
  for (const auto& [c, got, nearest] :
       {Midpoint{0x1p-900, odd, true}, Midpoint{0x1p-900, even, false}, Midpoint{-0x1p-900, even, true},
        Midpoint{-0x1p-900, odd, false}, Midpoint{0, even, true}, Midpoint{0, odd, false}}) {
    const Case point{FunctionId::fma, {a, b, c}, got, 0.5, nearest ? 0.0 : 1.0, "a midpoint, nearly"};
    expect_judged(point);
    for (const std::uint64_t index : {0U, 1U}) {
      const Summary full = judge_one<FullJudging<double>>(point, index);
      EXPECT_EQ(full.correctly_rounded, nearest ? 1U : 0U) << c << " " << got;
      EXPECT_EQ(recorded_figures(full), recorded_figures(judge_one<ScreenedJudging<double>>(point, index)));
    }
    if (c != 0 && nearest) {
      EXPECT_EQ(std::fma(a, b, c), got) << "what IEEE 754 asks for";
    }
  }
}

TEST(DirectionOfRounding, IsTheSameForTheScreen) {
  for (const Case& c : cases()) {
    // Index 0 is a checked one, index 1 not.
    for (const std::uint64_t index : {0U, 1U}) {
      EXPECT_EQ(recorded_figures(judge_one<ScreenedJudging<double>>(c, index)),
                recorded_figures(judge_one<FullJudging<double>>(c, index)))
          << info_of(c.id).name << ": " << c.why;
    }
  }
}

#ifdef ULPGATE_HAVE_FLOAT128
// A sum of terms 2^k apart has more bits than RealHP<4>, which rounds its error.
TEST(DirectionOfRounding, SumsOfTermsFarApartAreThoseOfTheFullReference) {
  for (const FunctionId id : {FunctionId::add, FunctionId::sub}) {
    const FunctionInfo& f = info_of(id);
    for (int apart = 130; apart < 480; ++apart) {
      const auto x = parse_real<Float128Real>("0x1.dfb51fadf9d623405da6f338250ep-12193");
      const Float128Real y =
          ldexp(parse_real<Float128Real>("0x1.0d3adaad297bc8fbb9a4888f5d2p-12193"), -apart);
      const std::vector<Float128Real> args = {x, y};
      const std::vector<Float128Real> results = {x};
      const std::uint8_t threw = 0;
      const auto figures = [&]<class Judging>(std::type_identity<Judging>, std::uint64_t index) {
        RowHint hint(1);
        RowTally<Float128Real> tally(f, hint);
        Judging judging(f);
        judging.judge(Batch<Float128Real>{f, args, results, {&threw, 1}, index}, tally);
        return recorded_figures(tally.take()[0]);
      };
      // Index 0 is a checked one.
      for (const std::uint64_t index : {0U, 1U}) {
        ASSERT_NO_THROW(EXPECT_EQ(figures(std::type_identity<ScreenedJudging<Float128Real>>{}, index),
                                  figures(std::type_identity<FullJudging<Float128Real>>{}, index)))
            << f.name << " " << apart;
      }
    }
  }
}
#endif

}  // namespace
}  // namespace ulpgate
