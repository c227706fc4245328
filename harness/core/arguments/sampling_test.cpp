// Tests of arguments: domains, strata, cells, binades, the hard trigonometric arguments, and fixed values.
#include "harness/core/arguments/sampling.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "reference/text/text.hpp"

namespace ulpgate {
namespace {

bool in_domain(DomainMap map, double x) {
  switch (map) {
    case DomainMap::PM1:
      return std::fabs(x) <= 1;
    case DomainMap::GTM1:
      return x >= -1;
    case DomainMap::GT1:
      return x >= 1;
    case DomainMap::GT0:
      return x >= 0 && !std::signbit(x);
    case DomainMap::NZ:
      return x != 0;
    case DomainMap::UINT:
      return x >= 0 && x == std::floor(x) && x <= 100;
    case DomainMap::INT:
      return x == std::floor(x) && std::fabs(x) <= 100;
    case DomainMap::MODPI:
      return x >= 0 && x < 3.15;
    case DomainMap::MOD2PI:
      return x >= 0 && x < 6.3;
    case DomainMap::ALL:
      return std::isfinite(x);
  }
  return false;
}

TEST(Arguments, StayInTheDomainOfEveryFunction) {
  for (const auto& f : all_functions()) {
    for (const auto s : {Stratum::uniform, Stratum::stratified, Stratum::binades}) {
      const Arguments<double> arguments(f, {s, 3, 500, nullptr});
      for (std::uint64_t k = 0; k < 500; ++k) {
        double x[max_arity] = {};
        arguments.make(k, x);
        for (std::size_t i = 0; i < static_cast<std::size_t>(f.arity); ++i) {
          EXPECT_TRUE(in_domain(f.domain[i], x[i]))
              << f.name << " " << name_of(s) << " " << k << ": " << x[i];
        }
      }
    }
  }
}

TEST(Arguments, AreFixedForEver) {
  // A change here changes every record: raise the version in the plan's text with it.
  double x = 0;
  Arguments<double>(info_of(FunctionId::sin), {Stratum::uniform, 1, 100, nullptr}).make(0, &x);
  float y = 0;
  Arguments<float>(info_of(FunctionId::sin), {Stratum::uniform, 1, 100, nullptr}).make(0, &y);
  EXPECT_EQ(y, static_cast<float>(x)) << "both are the nearest to the same real number";
  MpfrReal<62> wide;
  Arguments<MpfrReal<62>>(info_of(FunctionId::sin), {Stratum::uniform, 1, 100, nullptr}).make(0, &wide);
  EXPECT_NEAR(static_cast<double>(wide), x, 1e-14)
      << "the first word decides the leading digits in every type";
}

TEST(Arguments, StratifiedPutsOnePointInEveryCell) {
  constexpr std::uint64_t n = 1000;
  for (const auto id : {FunctionId::sin, FunctionId::atan2, FunctionId::fma}) {
    const FunctionInfo& f = info_of(id);
    const Arguments<double> arguments(f, {Stratum::stratified, 1, n, nullptr});
    std::vector<std::set<long>> cells(static_cast<std::size_t>(f.arity));
    for (std::uint64_t k = 0; k < n; ++k) {
      double x[max_arity] = {};
      arguments.make(k, x);
      for (std::size_t i = 0; i < cells.size(); ++i)
        cells[i].insert(std::lround(std::floor((x[i] + 100) * n / 200)));
    }
    for (const auto& c : cells) EXPECT_EQ(c.size(), n) << f.name;
  }
}

TEST(Arguments, BinadesReachEveryExponentAndSubnormals) {
  std::set<int> exponents;
  const Arguments<double> arguments(info_of(FunctionId::sin), {Stratum::binades, 1, 8000, nullptr});
  for (std::uint64_t k = 0; k < 8000; ++k) {
    double x = 0;
    arguments.make(k, &x);
    exponents.insert(std::ilogb(x));
  }
  EXPECT_EQ(exponents.size(), 1023U + 1074U + 1U);
  EXPECT_EQ(*exponents.begin(), -1074);
}

TEST(Arguments, OfTheExhaustiveStratumAreTheBitPatternsOfFloat) {
  const Arguments<float> arguments(info_of(FunctionId::sin),
                                   {Stratum::exhaustive, 1, exhaustive_count, nullptr});
  float x = 0;
  arguments.make(0, &x);
  EXPECT_EQ(x, 1.0F) << "large errors are found first";
  arguments.make(1, &x);
  EXPECT_EQ(x, 1.0F + 0x1p-23F);
  std::vector<bool> seen(4096);
  for (std::uint64_t block = 0; block < 4096; ++block) {
    const std::uint64_t k = (block << 20U) | 12345U;
    arguments.make(k, &x);
    EXPECT_EQ(std::bit_cast<std::uint32_t>(x), detail::exhaustive_pattern(k));
    EXPECT_EQ(detail::exhaustive_pattern(k) & 0xfffffU, 12345U);
    seen[detail::exhaustive_pattern(k) >> 20U] = true;
  }
  EXPECT_EQ(std::ranges::count(seen, true), 4096) << "every block once";
}

TEST(RandomStream, FirstWordsOfManyPointsAreThoseOfEach) {
  for (const std::uint64_t seed : {1ULL, 0xfedcba9876543210ULL}) {
    const RandomStream stream(seed, "sin", "uniform");
    for (const std::uint64_t argument : {0U, 2U}) {
      std::array<std::uint64_t, 100> words{};
      constexpr std::uint64_t first = (std::uint64_t{1} << 40U) - 50;
      stream.first_words(first, argument, words);
      for (std::size_t i = 0; i < words.size(); ++i) {
        std::uint64_t word[1];
        stream.fill(first + i, argument, word);
        EXPECT_EQ(words[i], word[0]);
      }
      // Of every number of points: vectors, numbers beside them, and a rest.
      for (std::size_t count = 1; count < 30; ++count) {
        std::vector<std::uint64_t> some(count);
        stream.first_words(first, argument, some);
        EXPECT_TRUE(std::equal(some.begin(), some.end(), words.begin())) << count;
      }
    }
  }
}

TEST(Arguments, AWordIsPutIntoItsCellWithoutADivision) {
  SplitMix64 words(5);
  for (int i = 0; i < 20000; ++i) {
    const std::uint64_t any = words.word() >> (i % 64);
    const std::uint64_t cells = i % 7 == 0 ? std::uint64_t{1} << (i % 64) : std::max<std::uint64_t>(any, 1);
    const std::uint64_t cell = i % 5 == 0 ? cells - 1 : words.word() % cells;
    const std::uint64_t word = i % 11 == 0 ? ~std::uint64_t{0} : words.word();
    std::uint64_t want[1] = {word};
    detail::into_cell(want, cell, cells);
    ASSERT_EQ(detail::Cells(cells).into(word, cell), want[0]) << cells << ' ' << cell << ' ' << word;
  }
}

template <class Real>
void expect_points_of_many_are_those_of_each() {
  for (const FunctionInfo& f : all_functions()) {
    for (const Stratum s : {Stratum::uniform, Stratum::stratified}) {
      const Arguments<Real> arguments(f, {s, 1, 1000, nullptr});
      const auto arity = static_cast<std::size_t>(f.arity);
      std::vector<Real> many(150 * arity);
      arguments.make_all(7, 150, many.data());
      for (std::size_t i = 0; i < 150; ++i) {
        std::array<Real, max_arity> one{};
        arguments.make(7 + i, one.data());
        for (std::size_t j = 0; j < arity; ++j) EXPECT_EQ(many[i * arity + j], one[j]) << f.name;
      }
    }
  }
}

TEST(Arguments, OfManyPointsAreThoseOfEach) {
  expect_points_of_many_are_those_of_each<float>();
  expect_points_of_many_are_those_of_each<double>();
  expect_points_of_many_are_those_of_each<long double>();
}

// The value depends on the words alone: 200 w - 100 rounded once.
TEST(Arguments, NativeNumbersAreRoundedOnce) {
  SplitMix64 words(3);
  MpfrValue exact(160);
  for (int i = 0; i < 30000; ++i) {
    const std::uint64_t word[1] = {i % 3 == 0 ? 0x8000000000000000U + (words.word() >> (i % 60 + 1))
                                              : words.word()};
    mpfr_set_ui(exact, word[0], MPFR_RNDN);  // of 64 bits where ulpgate runs
    mpfr_mul_ui(exact, exact, 200, MPFR_RNDN);
    mpfr_div_2ui(exact, exact, 64, MPFR_RNDN);
    mpfr_sub_ui(exact, exact, 100, MPFR_RNDN);
    EXPECT_EQ(detail::on_minus_100_100<double>(word), mpfr_get_d(exact, MPFR_RNDN));
    EXPECT_EQ(detail::on_minus_100_100<float>(word), mpfr_get_flt(exact, MPFR_RNDN));
    EXPECT_EQ(detail::on_minus_100_100<long double>(word), mpfr_get_ld(exact, MPFR_RNDN));
    std::array<double, 19> many{};
    std::array<std::uint64_t, 19> same{};
    same.fill(word[0]);
    detail::on_minus_100_100(same, many.data());
    for (const double x : many) EXPECT_EQ(x, mpfr_get_d(exact, MPFR_RNDN));
  }
}

TEST(HardArguments, FindTheWorstCaseOfTrigonometricReductionInDouble) {
  // Kahan's and Ng's famous argument: 6381956970095103 * 2^797 lies 4.7e-19 from a multiple of pi/2.
  const auto list = nearest_to_multiples_of_half_pi(float_format<double>(), 1023);
  double least = 1;
  bool found = false;
  for (const auto& x : list) {
    found = found || mpfr_cmp_d(x.get(), 0x1.6ac5b262ca1ffp+849) == 0;
    MpfrValue s(1200);
    MpfrValue c(1200);
    mpfr_sin_cos(s, c, x, MPFR_RNDN);
    least = std::min({least, std::fabs(mpfr_get_d(s, MPFR_RNDN)), std::fabs(mpfr_get_d(c, MPFR_RNDN))});
  }
  EXPECT_TRUE(found);
  EXPECT_NEAR(least, 4.687165924254627e-19, 1e-25);
  EXPECT_GE(list.size(), 2U * 1024U);
}

TEST(ArgumentLists, EveryValueIsOneOfTheFormat) {
  for (const auto& format : {float_format<float>(), float_format<double>(), float_format<MpfrReal<62>>()}) {
    for (const auto& f : all_functions()) {
      for (const auto& list : {edge_arguments(f, format), hard_arguments(f, format)}) {
        for (const auto& point : list) {
          ASSERT_EQ(point.size(), static_cast<std::size_t>(f.arity)) << f.name;
          for (const auto& x : point) {
            MpfrValue rounded(mpfr_get_prec(x.get()));
            mpfr_set(rounded, x, MPFR_RNDN);
            round_to_format(rounded, format);
            ASSERT_TRUE(mpfr_nan_p(x.get()) || mpfr_equal_p(rounded.get(), x.get())) << f.name;
          }
        }
      }
      EXPECT_GT(edge_arguments(f, format).size(), 4U) << f.name;
      EXPECT_EQ(hard_arguments(f, format).empty(), f.hard == HardFamily::none) << f.name;
    }
  }
}

}  // namespace
}  // namespace ulpgate
