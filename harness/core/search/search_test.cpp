// Tests of the search: positions are exact and in order, a planted spike is found, threads change nothing.
#include "harness/core/search/search.hpp"

#include <gtest/gtest.h>

#include <thread>

#include "harness/core/search/function_search.hpp"
#include "harness/core/search/function_target.hpp"
#include "harness/core/search/search_positions.hpp"
#include "harness/core/subject/registry.hpp"

namespace ulpgate {
namespace {

template <class Real>
class PositionsOf : public testing::Test {};
using SearchedTypes = testing::Types<float, double, long double,
#ifdef ULPGATE_HAVE_FLOAT128
                                     Float128Real,
#endif
                                     MpfrReal<62>, CppBinFloatReal<62>>;
TYPED_TEST_SUITE(PositionsOf, SearchedTypes);

TYPED_TEST(PositionsOf, AreInOrderAndExactBothWays) {
  using Real = TypeParam;
  const FloatFormat format = float_format<Real>();
  const long least = std::max(format.exponent_least(), -16494L);
  const Positions<Real> positions(least);
  std::vector<MpfrValue> values;
  const auto add = [&](long m, long exponent) {
    for (const long step : {-2L, -1L, 0L, 1L, 2L}) {
      MpfrValue v(format.precision + 64);
      mpfr_set_si_2exp(v, m, exponent, MPFR_RNDN);
      step_in_format(v, step, format);
      values.push_back(std::move(v));
    }
  };
  for (const long m : {-1L, 1L}) {
    for (const long e : {0L, -3L, 100L, format.exponent_min + 3, -60L}) add(m, std::max(e, least + 2));
    add(3 * m, 17);
  }
  std::ranges::sort(values, [](const auto& a, const auto& b) { return mpfr_less_p(a.get(), b.get()) != 0; });
  for (std::size_t i = 0; i < values.size(); ++i) {
    const Real x = from_mpfr<Real>(values[i]);
    EXPECT_EQ(positions.at(positions.of(x)), x);
    if (i == 0) continue;
    const Real before = from_mpfr<Real>(values[i - 1]);
    EXPECT_LT(positions.of(before), positions.of(x));
    // The five of a group are neighbours, and so are their positions.
    if (i % 5 == 0) continue;
    EXPECT_TRUE(width_of(positions.of(before), positions.of(x)) == 1);
  }
  EXPECT_EQ(positions.of(Real(0)), 0);
  EXPECT_EQ(positions.at(0), Real(0));
}

TEST(Positions, OfTheWholeOfBinary128FitTheirWidth) {
#ifdef ULPGATE_HAVE_FLOAT128
  const FunctionTarget<Float128Real, NoWideType> target(
      info_of(FunctionId::sin), function_table<Float128Real>()[static_cast<std::size_t>(FunctionId::sin)]);
  const auto box = target.domain();
  EXPECT_EQ(bit_length(width_of(box.low[0], box.high[0])), 128);
  SearchRandom random(1);
  for (int i = 0; i < 1000; ++i) EXPECT_TRUE(box.contains(box.draw(random, 1), 1));
#endif
}

// A flat sea with small waves, and one spike, 2^-15 of the space wide at its foot (2^-7 in two dimensions),
// that rises towards its top.
class PlantedSpike final : public SearchTarget<__int128> {
 public:
  explicit PlantedSpike(std::size_t arity) : arity_(arity) {}
  std::size_t arity() const override { return arity_; }
  SearchBox<__int128> domain() const override {
    SearchBox<__int128> box;
    for (std::size_t i = 0; i < arity_; ++i) {
      box.low[i] = -(__int128{1} << 62);
      box.high[i] = __int128{1} << 62;
    }
    return box;
  }
  double error(const SearchPoint<__int128>& x) const {
    double sum = 0;
    std::uint64_t waves = 0;
    for (std::size_t i = 0; i < arity_; ++i) {
      const double apart = static_cast<double>(x[i] - top);
      sum += std::log2(1 + std::fabs(apart));
      waves = SearchRandom(waves ^ static_cast<std::uint64_t>(x[i])).word();
    }
    const double noise = std::ldexp(static_cast<double>(waves >> 11U), -54);
    return noise + std::max(0.0, 8 - sum / static_cast<double>(arity_) / (arity_ == 1 ? 6 : 7.5));
  }
  void rank(std::span<const SearchPoint<__int128>> points, std::span<double> errors) const override {
    for (std::size_t i = 0; i < points.size(); ++i) {
      // Estimates: a little off.
      errors[i] = error(points[i]) * 1.001;
      if (points[i][0] % 1000 == 7) errors[i] = std::numeric_limits<double>::infinity();
    }
  }
  Judgement confirm(const SearchPoint<__int128>& x) const override {
    if (x[0] % 1000 == 7) return {Outcome::nan, {}, 0, false};
    return {Outcome::finite, {error(x)}, 1, false};
  }
  int cheap_scale() const override { return 62; }
  int significand_bits() const override { return 53; }
  void distrust_estimates() override { ADD_FAILURE() << "estimates within 1/1000 are good"; }

  static constexpr __int128 top = (__int128{1} << 55) + 123456789;

 private:
  std::size_t arity_;
};

Search<__int128>::Found hunted(std::size_t arity, std::uint64_t evaluations, std::uint64_t seed,
                               bool backwards, std::uint64_t* done = nullptr) {
  PlantedSpike target(arity);
  Search<__int128> search(target, {target.domain()}, {}, seed, {1U << 14U});
  while (search.evaluations() < evaluations) {
    const std::size_t n = search.begin_round(evaluations - search.evaluations());
    for (std::size_t i = 0; i < n; ++i) search.run_batch(backwards ? n - 1 - i : i);
    search.end_round();
  }
  if (done != nullptr) *done = search.evaluations();
  EXPECT_TRUE(search.mismatches().contains(Outcome::nan)) << "one in 1000 points is one";
  return search.best();
}

TEST(Search, FindsAPlantedSpike) {
  // The waves are 0.5 high, the spike 8.  The nearest of so many random points comes within 2^42 of it
  // (2^52 in two dimensions), where it is 1 high.
  EXPECT_GT(hunted(1, 1U << 21U, 1, false).error, 7.5);
  EXPECT_GT(hunted(2, 1U << 22U, 1, false).error, 6);
}

TEST(Search, DependsOnSeedAndEvaluationsAlone) {
  std::uint64_t done = 0;
  const auto a = hunted(2, 100001, 5, false, &done);
  EXPECT_EQ(done, 100001U);
  const auto b = hunted(2, 100001, 5, true);
  EXPECT_EQ(a.at, b.at);
  EXPECT_EQ(a.error, b.error);
  EXPECT_EQ(a.evaluations, b.evaluations);
  EXPECT_NE(hunted(2, 100001, 6, false).at, a.at);
}

TEST(Search, WrongEstimatesAreFoundOut) {
  class Liar final : public SearchTarget<__int128> {
   public:
    std::size_t arity() const override { return 1; }
    SearchBox<__int128> domain() const override {
      SearchBox<__int128> box;
      box.high[0] = 1000000;
      return box;
    }
    void rank(std::span<const SearchPoint<__int128>> points, std::span<double> errors) const override {
      for (std::size_t i = 0; i < points.size(); ++i)
        errors[i] = distrusted ? truth(points[i]) : static_cast<double>(points[i][0]);
    }
    Judgement confirm(const SearchPoint<__int128>& x) const override {
      return {Outcome::finite, {truth(x)}, 1, false};
    }
    int cheap_scale() const override { return 62; }
    int significand_bits() const override { return 20; }
    void distrust_estimates() override { distrusted = true; }
    // The estimate grows to the right, the truth lies at 1000.
    static double truth(const SearchPoint<__int128>& x) {
      return 1 / (1 + std::fabs(static_cast<double>(x[0]) - 1000));
    }
    bool distrusted = false;
  };
  Liar target;
  Search<__int128> search(target, {target.domain()}, {}, 1, {4096});
  while (search.evaluations() < 400000) {
    const std::size_t n = search.begin_round(4096);
    for (std::size_t i = 0; i < n; ++i) search.run_batch(i);
    search.end_round();
  }
  EXPECT_TRUE(target.distrusted);
  EXPECT_EQ(search.best().error, 1);
}

TEST(FunctionSearch, HuntsInEveryTypeAndWithSeveralArguments) {
  for (const auto& type : all_types()) {
    for (const auto* name : {"cbrt", "pow", "cexp"}) {
      const Subject& subject = *find_subject(name, type.token);
      const auto search = make_search(subject, 1);
      while (search->evaluations() < 300) {
        const std::size_t n = search->begin_round(300 - search->evaluations());
        for (std::size_t i = 0; i < n; ++i) search->run_batch(i);
        search->end_round();
      }
      EXPECT_EQ(search->evaluations(), 300U);
      EXPECT_GT(search->best_error_ulp(), 0) << name << " " << type.token;
      const Point point = subject.point(search->best().args);
      double error = 0;
      for (const auto& part : point.parts) error = std::max(error, part.judgement.error.value);
      EXPECT_EQ(error, search->best_error_ulp()) << "what is reported is what `ulpgate at` shows";
    }
  }
  EXPECT_FALSE(can_search(*find_subject("factorial", "double")));
}

TEST(FunctionSearch, BeatsRandomSamplingInDouble) {
  const auto search = make_search(*find_subject("erfc", "double"), 1);
  while (search->evaluations() < 400000) {
    const std::size_t n = search->begin_round(400000 - search->evaluations());
    for (std::size_t i = 0; i < n; ++i) search->run_batch(i);
    search->end_round();
  }
  // 2e7 random arguments on (-100, 100) find 3.26 (glibc 2.36); any libm has more than 1 ULP to be found.
  EXPECT_GT(search->best_error_ulp(), 1);
}

TEST(EstimatedError, SuspectsWhatIsNoOrdinaryNumber) {
  const double inf = std::numeric_limits<double>::infinity();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  struct Case {
    double got;
    long double wide;
    double want;
    const char* why;
  };
  for (const auto& [got, wide, want, why] : {
           Case{1, 1, 0, "exact"},
           Case{1, 1 + 0x1p-53L, 0.5, "half a ULP"},
           Case{0x1p-1074, 0x1.8p-1074L, 0.5, "the spacing of subnormals"},
           Case{nan, std::numeric_limits<long double>::quiet_NaN(), 0, "an agreed NaN"},
           Case{nan, 1, inf, "NaN for a value"},
           Case{1, std::numeric_limits<long double>::quiet_NaN(), inf, "a value for NaN"},
           Case{inf, 0x1p+1024L, 0, "both overflow"},
           Case{inf, 1, inf, "spurious overflow"},
           Case{-inf, 0x1p+1024L, inf, "the wrong infinity"},
           Case{1, 0x1p+1024L, inf, "missed overflow"},
           Case{0, 0x1p-1070L, inf, "spurious underflow"},
           Case{0, 0x1p-1075L, 0.5, "rounded to zero"},
           Case{1, 0, inf, "a value for zero"},
       }) {
    EXPECT_EQ(estimated_error(got, wide), want) << why;
  }
}

}  // namespace
}  // namespace ulpgate
