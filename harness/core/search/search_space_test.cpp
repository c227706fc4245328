// Tests of the space of a search (lengths of integers, even draws, cuts without loss, the ends of positions,
// the polynomial that stands for a function over a narrow interval), and of functions as its targets: what
// ranks them, and searches that no C library has a say in.
#include "harness/core/search/search_space.hpp"

#include <gtest/gtest.h>

#include <set>

#include "harness/core/search/function_target.hpp"
#include "harness/core/search/local_polynomial.hpp"
#include "harness/core/search/search_bands.hpp"
#include "harness/core/search/search_elites.hpp"
#include "harness/core/search/search_positions.hpp"
#include "harness/core/testing/fingerprint.hpp"

namespace ulpgate {
namespace {
using Wide = WidePosition<256>;

TEST(SearchSpace, TheLengthOfAnIntegerIsThatOfItsBits) {
  EXPECT_EQ(bit_length(Wide(0)), 0);
  EXPECT_EQ(bit_length(Wide(1)), 1);
  EXPECT_EQ(bit_length(Wide(5)), 3);
  EXPECT_EQ(bit_length(Wide(Wide(1) << 200)), 201);
  EXPECT_EQ(bit_length(static_cast<unsigned __int128>(0)), 0);
  EXPECT_EQ(bit_length(static_cast<unsigned __int128>(5)), 3);
  EXPECT_EQ(bit_length(static_cast<unsigned __int128>(5) << 80U), 83);
}

template <class W>
void expect_every_value_up_to(const W& greatest, int count) {
  SearchRandom random(1);
  std::set<long> low;
  for (int i = 0; i < 4000; ++i) {
    const W x = random.up_to(greatest);
    EXPECT_TRUE(x >= 0 && x <= greatest);
    low.insert(static_cast<long>(x & W(7)));
  }
  EXPECT_EQ(low.size(), static_cast<std::size_t>(count));
}

TEST(SearchSpace, DrawsReachEveryPositionUpToTheGreatest) {
  expect_every_value_up_to<unsigned __int128>(5, 6);
  expect_every_value_up_to<Wide>(5, 6);
  // Odd ones too.
  expect_every_value_up_to<unsigned __int128>(static_cast<unsigned __int128>(5) << 80U, 8);
  expect_every_value_up_to<Wide>(Wide(Wide(5) << 150), 8);
}

TEST(SearchSpace, ABoxIsCutIntoPartsThatMeet) {
  SearchBox<__int128> box;
  box.low = {-7, 100};
  box.high = {1000, 200};
  box.best = {-7, 150};
  box.error = 3;
  std::vector<SearchBox<__int128>> parts;
  box.split(0, 4, 2, parts);
  ASSERT_EQ(parts.size(), 4U);
  EXPECT_TRUE(parts.front().low[0] == -7) << "the first begins where the box does";
  EXPECT_TRUE(parts.back().high[0] == 1000);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (i > 0) {
      EXPECT_TRUE(parts[i].low[0] == parts[i - 1].high[0] + 1);
    }
    EXPECT_TRUE(parts[i].low[1] == 100 && parts[i].high[1] == 200);
    EXPECT_EQ(parts[i].error, i == 0 ? 3 : -1) << "what holds the best point inherits it";
  }
}

// Types without subnormals: the least number that has a position, and what lies below it.
TEST(Positions, OfTheFirstBinadeAreThoseOfItsNumbers) {
  using Real = MpfrReal<62>;
  constexpr long least = -300;
  const Positions<Real> positions(least);
  const Real first = ldexp(Real(1), least);
  const Real last = first * (Real(2) - std::numeric_limits<Real>::epsilon());
  for (const Real& x : {first, Real(-first), last, Real(first * 2)})
    EXPECT_EQ(positions.at(positions.of(x)), x);
  EXPECT_EQ(positions.of(Real(first / 2)), 0);
  EXPECT_EQ(positions.at(positions.of(first) - 1), Real(0));
  EXPECT_TRUE(width_of(positions.of(last), positions.of(Real(first * 2))) == 1);
}

// Of one neighbourhood six are kept and taken, whatever else there is.
TEST(SearchElites, TakeSixOfANeighbourhood) {
  SearchBox<__int128> domain;
  domain.high[0] = __int128{1} << 40;
  SearchElites<__int128> elites(domain, 1);
  for (int i = 0; i < 5; ++i) elites.add({{1000 + i}, 10.0 + i});
  EXPECT_TRUE(elites.would_take({2000}, 5)) << "the sixth";
  for (int i = 0; i < 20; ++i) elites.add({{(__int128{1} << 39) + (__int128{i} << 30)}, 30.0 + i});
  EXPECT_TRUE(elites.would_take({2000}, 5)) << "the others are no neighbours";
  EXPECT_FALSE(elites.would_take({1003}, 13)) << "is there already";
  elites.add({{2000}, 5});
  EXPECT_FALSE(elites.would_take({3000}, 4)) << "the seventh";
  EXPECT_TRUE(elites.would_take({3000}, 11.5)) << "better than some of the six";
}

double value_of(double t) {
  return 1 + t * (0.5 + t * (0.25 - t * 0.125));
}

TEST(LocalPolynomial, IsTheFunctionWhereItFits) {
  LocalPolynomial<double> polynomial;
  constexpr double low = 3;
  constexpr double high = 3 + 0x1p-8;
  const auto f = [](double x) { return value_of(x - 3); };
  std::array<TwoPart<double>, LocalPolynomial<double>::nodes + LocalPolynomial<double>::checks> values;
  const auto args = polynomial.choose(low, high);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = {f(args[i]), 0};
  ASSERT_TRUE(polynomial.fit(values, 0x1p-51));
  for (int i = 0; i <= 100; ++i) {
    const double x = low + (high - low) * i / 100;
    EXPECT_NEAR(polynomial.difference(x, f(x)), 0, 0x1p-51);
    EXPECT_NEAR(polynomial.difference(x, f(x) + 0x1p-20), -0x1p-20, 0x1p-51);
  }
  // A cube that is not smooth is found out by the checks.
  values[LocalPolynomial<double>::nodes].high += 0x1p-30;
  EXPECT_FALSE(polynomial.fit(values, 0x1p-51));
}

TEST(LocalPolynomial, AConstantFitsWithoutTolerance) {
  LocalPolynomial<double> polynomial;
  polynomial.choose(1, 1.5);
  std::array<TwoPart<double>, LocalPolynomial<double>::nodes + LocalPolynomial<double>::checks> values;
  values.fill({2, 0});
  EXPECT_TRUE(polynomial.fit(values, 0));
  EXPECT_EQ(polynomial.difference(1.25, 2), 0);
}

using testing::Fingerprint;
using testing::literal;

const FunctionInfo& named(std::string_view name) {
  return info_of(find_function(name)->id);
}

// Of all arguments of the calls below, in their order; one thread.
Fingerprint called;

// Roots and quotients that are wrong now and then, by operations that round correctly.
template <RealType Real>
void rough_sqrt(const Real* x, Real* y, std::uint8_t*, std::size_t count) {
  using std::sqrt;
  for (std::size_t i = 0; i < count; ++i) {
    called.add_value(x[i]);
    y[i] = x[i] == Real(0) ? x[i] : Real(x[i] / Real(sqrt(x[i])));
  }
}
template <RealType Real>
void rough_div(const Real* x, Real* y, std::uint8_t*, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    called.add_value(x[2 * i]);
    called.add_value(x[2 * i + 1]);
    y[i] = x[2 * i] * Real(Real(1) / x[2 * i + 1]);
  }
}

// One point throws, one is a NaN: among neighbours that a polynomial ranks, at once.
void sqrt_with_two_holes(const double* x, double* y, std::uint8_t* threw, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    y[i] = x[i] / std::sqrt(x[i]);
    if (i == 10) threw[i] = 1;
    if (i == 20) y[i] = std::numeric_limits<double>::quiet_NaN();
  }
}

std::vector<double> ranked_cluster(BatchFunction<double> call, double from) {
  const FunctionTarget<double, NoWideType> target(named("sqrt"), call);
  const Positions<double> positions(-1074);
  std::vector<SearchPoint<__int128>> points;
  points.reserve(64);
  for (int i = 0; i < 64; ++i) points.push_back({positions.of(from) + __int128{987654321} * i});
  std::vector<double> errors(points.size());
  target.rank(points, errors);
  return errors;
}

TEST(FunctionTarget, NeighboursThatThrowOrAreNoNumberAreSuspects) {
  const auto errors = ranked_cluster(&sqrt_with_two_holes, 1.25);
  const auto whole = ranked_cluster(&rough_sqrt<double>, 1.25);
  for (std::size_t i = 0; i < errors.size(); ++i) {
    if (i == 10 || i == 20) {
      EXPECT_TRUE(std::isinf(errors[i])) << i;
    } else {
      EXPECT_EQ(errors[i], whole[i]) << i;
    }
  }
}

// Roots of numbers with a factor of 4 between them differ by powers of two: what a polynomial says is the
// same to the bit, what MPFR says differs from it in the last ones.
TEST(FunctionTarget, APolynomialRanksUpToHalfOfTheExponents) {
  const auto middle = ranked_cluster(&rough_sqrt<double>, 1.25);
  for (const double e : {0x1p1022, 0x1p1020, 0x1p-900})
    EXPECT_EQ(ranked_cluster(&rough_sqrt<double>, 1.25 * e), middle) << e;
}

struct Result {
  std::string_view name;
  std::uint64_t evaluations;  // when the best was found
  std::uint64_t at;           // of its arguments
  double error;
  double distance;
  std::uint64_t calls;  // all arguments of calls
};

template <RealType Real>
Result searched(std::string_view name, std::string_view function, BatchFunction<Real> call,
                std::uint64_t evaluations, bool elsewhere) {
  const FunctionInfo& f = named(function);
  called = {};
  FunctionTarget<Real, NoWideType> target(f, call);
  const ArgumentList edges = edge_arguments(f, float_format<Real>());
  if (elsewhere) target.pass_over(edges);
  Search<PositionOf<Real>> search(
      target, target.ordinary_boxes(),
      target.seeds(elsewhere ? ArgumentList{} : edge_arguments(f, float_format<Real>())), 5, {1U << 11U});
  while (search.evaluations() < evaluations) {
    const std::size_t n = search.begin_round(evaluations - search.evaluations());
    for (std::size_t i = 0; i < n; ++i) search.run_batch(i);
    search.end_round();
  }
  EXPECT_EQ(search.evaluations(), evaluations);
  Fingerprint at;
  for (const auto& x : target.values(search.best().at)) at.add_value(x.get());
  return {name,          search.best().evaluations, at.value(), search.best().error, search.best().distance,
          called.value()};
}

constexpr Result results[] = {
    {"sqrt, float", 10345, 0x92725419120d52ba, 0x1.7fff906c1fe54p-1, 1, 0xe7586155180b730d},
    {"sqrt, double", 49769, 0x8822994277fc0cd4, 0x1.7ffe0b67f2b28p-1, 1, 0x546d68a7a670e8ad},
    {"div, double", 19748, 0xc68ce3b010f35c0a, 0x1.5b36e068e3275p+1, 3, 0xe35cf1fbd772bed7},
    {"elsewhere", 11008, 0x3872af40c27fc38b, 0x1.7ffcb2791dbdap-1, 1, 0x50e075218e6d882d},
    {"sqrt, mpfr62", 15717, 0x84f15bcd6beadc19, 0x1.7ff991d16970bp-1, 1, 0x12e0433f16b56782},
    {"div, mpfr62", 8708, 0x695d8c1c128519b4, 0x1.7a293159ed6e8p+0, 1, 0xdc1dd7cdc179e75e},
};

// As for the synthetic targets of search_fingerprints_test.cpp: a change is a decision.
TEST(FunctionTarget, SearchesOfExactFunctionsFindTheSameForEver) {
  using Wide = MpfrReal<62>;
  const Result now[] = {
      searched<float>("sqrt, float", "sqrt", &rough_sqrt<float>, 60001, false),
      searched<double>("sqrt, double", "sqrt", &rough_sqrt<double>, 60001, false),
      searched<double>("div, double", "div", &rough_div<double>, 20001, false),
      searched<double>("elsewhere", "sqrt", &rough_sqrt<double>, 40001, true),
      searched<Wide>("sqrt, mpfr62", "sqrt", &rough_sqrt<Wide>, 20001, false),
      searched<Wide>("div, mpfr62", "div", &rough_div<Wide>, 10001, false),
  };
  for (std::size_t i = 0; i < std::size(results); ++i) {
    const Result& want = results[i];
    char error[40];
    std::snprintf(error, sizeof error, "%a", now[i].error);
    EXPECT_TRUE(want.name == now[i].name && want.evaluations == now[i].evaluations && want.at == now[i].at &&
                want.error == now[i].error && want.distance == now[i].distance && want.calls == now[i].calls)
        << "now {\"" << now[i].name << "\", " << now[i].evaluations << ", " << literal(now[i].at) << ", "
        << error << ", " << now[i].distance << ", " << literal(now[i].calls) << "},";
  }
}

}  // namespace
}  // namespace ulpgate
