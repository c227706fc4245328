// Tests of the space of a search: lengths of integers, even draws, cuts without loss, the ends of positions,
// and the polynomial that stands for a function over a narrow interval.
#include "harness/core/search/search_space.hpp"

#include <gtest/gtest.h>

#include <set>

#include "harness/core/search/local_polynomial.hpp"
#include "harness/core/search/search_bands.hpp"
#include "harness/core/search/search_elites.hpp"
#include "harness/core/search/search_positions.hpp"

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

}  // namespace
}  // namespace ulpgate
