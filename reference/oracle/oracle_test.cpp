// Tests of the oracle by other oracles: identities, cpp_bin_float's own functions, known zeros, condition
// numbers.
#include "reference/oracle/oracle.hpp"

#include <gtest/gtest.h>

#include <boost/math/special_functions/bessel.hpp>
#include <boost/math/special_functions/laguerre.hpp>
#include <boost/math/special_functions/spherical_harmonic.hpp>
#include <cmath>

#include "reference/condition/condition.hpp"
#include "reference/condition/condition_bound.hpp"
#include "reference/oracle/oracle_erf.hpp"
#include "reference/oracle/oracle_gamma.hpp"
#include "reference/types/exchange.hpp"

namespace ulpgate {
namespace {

constexpr long bits = 300;

std::vector<MpfrValue> vector(std::initializer_list<const char*> texts) {
  std::vector<MpfrValue> v;
  for (const char* t : texts) {
    v.emplace_back(bits);
    EXPECT_NE(mpfr_set_str(v.back(), t, 0, MPFR_RNDN), -1) << t;
  }
  return v;
}

std::vector<MpfrValue> exact(FunctionId id, std::initializer_list<const char*> args) {
  std::vector<MpfrValue> out;
  out.reserve(static_cast<std::size_t>(info_of(id).parts));
  for (int i = 0; i < info_of(id).parts; ++i) out.emplace_back(bits);
  exact_value(info_of(id), vector(args), out);
  return out;
}

// Relative difference below 2^-exponent.
void expect_close(mpfr_srcptr a, mpfr_srcptr b, long exponent, const char* why) {
  if (mpfr_equal_p(a, b)) return;
  MpfrValue d(bits);
  mpfr_reldiff(d, a, b, MPFR_RNDN);
  EXPECT_LT(mpfr_get_exp(d.get()), -exponent) << why;
}

using Wide = CppBinFloatReal<100>;

Wide wide(const MpfrValue& x) {
  return from_mpfr<Wide>(x);
}

TEST(Oracle, SpecialFunctionsAgreeWithBoostInCppBinFloat) {
  struct Row {
    FunctionId id;
    std::initializer_list<const char*> args;
    Wide re, im;
  };
  const Wide x("2.625");
  const Wide t("0.75");
  const Wide p("4.5");
  const Row rows[] = {
      {FunctionId::cyl_bessel_j, {"3", "2.625"}, boost::math::cyl_bessel_j(3, x), 0},
      {FunctionId::laguerre, {"5", "2", "2.625"}, boost::math::laguerre(5U, 2U, x), 0},
      {FunctionId::laguerre, {"0", "4", "2.625"}, boost::math::laguerre(0U, 4U, x), 0},
      {FunctionId::spherical_harmonic,
       {"4", "3", "0.75", "4.5"},
       boost::math::spherical_harmonic_r(4U, 3, t, p),
       boost::math::spherical_harmonic_i(4U, 3, t, p)},
      {FunctionId::spherical_harmonic,
       {"4", "-3", "0.75", "4.5"},
       boost::math::spherical_harmonic_r(4U, -3, t, p),
       boost::math::spherical_harmonic_i(4U, -3, t, p)},
      {FunctionId::spherical_harmonic,
       {"7", "0", "0.75", "4.5"},
       boost::math::spherical_harmonic_r(7U, 0, t, p),
       0},
      {FunctionId::spherical_harmonic, {"2", "3", "0.75", "4.5"}, 0, 0},
      {FunctionId::factorial, {"30"}, Wide("265252859812191058636308480000000"), 0},
  };
  for (const auto& row : rows) {
    const auto got = exact(row.id, row.args);
    const auto near = [&](const Wide& a, const Wide& b) {
      return abs(a - b) <= Wide("1e-90") * (abs(b) + Wide("1e-5"));
    };
    EXPECT_TRUE(near(wide(got[0]), row.re)) << info_of(row.id).name << " " << wide(got[0]) << " " << row.re;
    if (got.size() > 1) {
      EXPECT_TRUE(near(wide(got[1]), row.im)) << info_of(row.id).name << " im";
    }
  }
}

// Correctly rounded like MPFR's own, with the same word on what was rounded which way, and by our formulas
// wherever they are said to serve: one that always left the work to MPFR would be right as well.
TEST(Oracle, GammasNextToZeroAreThoseOfMpfr) {
  const WideExponentRange range;
  const auto sign = [](int n) { return (n > 0) - (n < 0); };
  int by_series = 0;
  for (const long precision : {24L, 64L, 113L, 145L, 239L, 828L}) {
    for (const long exponent : {-7L, -8L, -9L, -13L, -20L, -40L, -75L, -149L, -1074L, -20000L}) {
      for (const char* digits : {"1", "-1", "1.9", "-1.37", "0x1.fffffep+0", "-0x1.55555555555555p+0"}) {
        MpfrValue x(precision), got(precision), want(precision);
        mpfr_set_str(x, digits, 0, MPFR_RNDN);
        mpfr_mul_2si(x, x, exponent, MPFR_RNDN);
        const std::string at =
            std::string(digits) + " 2^" + std::to_string(exponent) + " in " + std::to_string(precision);
        const bool ours = oracle::series_serves_gamma(x, precision);
        // Whether 32 bits beyond the wanted ones decide the rounding: Gamma(x) is 1/x - 0.577..., and 1/x may
        // have few bits.
        const auto decides = [&](auto&& function) {
          MpfrValue value(precision + 40);
          function(value, x, MPFR_RNDN);
          return mpfr_can_round(value, precision + 32, MPFR_RNDN, MPFR_RNDZ, precision + 1) != 0;
        };
        oracle::RoundingMade rounding = oracle::gamma(got, x);
        EXPECT_EQ(rounding.method == oracle::Method::formula, ours && decides(mpfr_gamma)) << "gamma " << at;
        EXPECT_EQ(sign(rounding.ternary), sign(mpfr_gamma(want, x, MPFR_RNDN))) << at;
        EXPECT_NE(mpfr_equal_p(got, want), 0) << "gamma " << at;
        by_series += rounding.method == oracle::Method::formula ? 1 : 0;
        int ignored = 0;
        rounding = oracle::log_gamma(got, x);
        const auto lgamma = [](mpfr_ptr out, mpfr_srcptr a, mpfr_rnd_t nearest) {
          int of_gamma = 0;
          return mpfr_lgamma(out, &of_gamma, a, nearest);
        };
        EXPECT_EQ(rounding.method == oracle::Method::formula, ours && decides(lgamma)) << "lgamma " << at;
        EXPECT_EQ(sign(rounding.ternary), sign(mpfr_lgamma(want, &ignored, x, MPFR_RNDN))) << at;
        EXPECT_NE(mpfr_equal_p(got, want), 0) << "lgamma " << at;
      }
    }
  }
  EXPECT_GT(by_series, 150);
}

TEST(Oracle, ErrorFunctionsAreThoseOfMpfr) {
  const WideExponentRange range;
  const auto sign = [](int n) { return (n > 0) - (n < 0); };
  int by_rule = 0;
  std::vector<double> points = {1.5, 0x1.7ffffffffffffp+0, 64, 0x1.0000000000001p+6, 26.5, 100, 1e9};
  // Around the ends of the strips, sqrt(bits ln 2), of all precisions below.
  for (double x = 1.6; x < 30; x += 0.83) points.push_back(x);
  for (const long precision : {24L, 56L, 85L, 113L, 145L, 239L, 532L}) {
    const double strip = std::sqrt(static_cast<double>(precision + 52) * std::log(2.0));
    for (const double offset : {-0.5, -0.4, -0.01, 0.0, 0.01, 0.4, 0.5, 1.0})
      points.push_back(strip + offset);
  }
  for (const long precision : {24L, 56L, 85L, 113L, 145L, 239L, 532L}) {
    for (std::size_t i = 0; i < points.size(); ++i) {
      // MPFR's own takes milliseconds a point there.
      if (precision > 200 && points[i] > 12 && i % 5 != 0) continue;
      for (const int side : {1, -1}) {
        MpfrValue x(std::min(precision, 200L)), got(precision), want(precision);
        mpfr_set_d(x, side * points[i], MPFR_RNDN);
        mpfr_div_ui(x, x, 3, MPFR_RNDN);
        mpfr_mul_ui(x, x, 3, MPFR_RNDN);
        const std::string at = std::to_string(side * points[i]) + " in " + std::to_string(precision);
        oracle::RoundingMade rounding = oracle::complementary_error_function(got, x);
        bool ours = oracle::rule_serves_erfc(x, precision);
        by_rule += ours ? 1 : 0;
        EXPECT_EQ(rounding.method == oracle::Method::formula, ours) << "erfc " << at;
        EXPECT_EQ(sign(rounding.ternary), sign(mpfr_erfc(want, x, MPFR_RNDN))) << at;
        EXPECT_NE(mpfr_equal_p(got, want), 0) << "erfc " << at;
        rounding = oracle::error_function(got, x);
        ours = oracle::rule_serves_erf(x, precision);
        by_rule += ours ? 1 : 0;
        EXPECT_EQ(rounding.method == oracle::Method::formula, ours) << "erf " << at;
        EXPECT_EQ(sign(rounding.ternary), sign(mpfr_erf(want, x, MPFR_RNDN))) << at;
        EXPECT_NE(mpfr_equal_p(got, want), 0) << "erf " << at;
      }
    }
  }
  EXPECT_GT(by_rule, 1000);
}

TEST(Oracle, TheRuleIsForModerateArgumentsWhereErfcReachesIntoTheSum) {
  struct Case {
    double x;
    long precision;
    bool erf, erfc;
    const char* why;
  };
  for (const auto& [point, precision, erf, erfc, why] : {
           Case{1.5, 53, true, true, "the least argument"},
           Case{1.49, 53, false, false, "MPFR's Taylor series is short"},
           Case{6, 53, true, true, "52 bits below 1, and 53 wanted"},
           Case{7, 53, false, true, "1 - erfc(7) is 1 to 70 bits"},
           Case{7, 145, true, true, "not to 145"},
           Case{64, 828, false, true, "the greatest argument"},
           Case{64.5, 828, false, false, "MPFR's asymptotic series serves"},
           Case{-6, 53, true, true, "2 - erfc(6)"},
           Case{-7, 53, false, false, "2 to 70 bits"},
           Case{2, 6001, false, false, "no such precision"},
       }) {
    MpfrValue x(53);
    mpfr_set_d(x, point, MPFR_RNDN);
    EXPECT_EQ(oracle::rule_serves_erf(x, precision), erf) << point << ": " << why;
    EXPECT_EQ(oracle::rule_serves_erfc(x, precision), erfc) << point << ": " << why;
  }
}

TEST(Oracle, OwnComplexFormulasAgreeWithMpc) {
  const char* points[][2] = {{"1", "2"},      {"-0.3", "0.7"}, {"1e-5", "-3"},
                             {"40", "-1e-3"}, {"-2.5", "0"},   {"0", "11"}};
  for (const auto& p : points) {
    const auto a = vector({p[0], p[1]});
    const auto tan = exact(FunctionId::ctan, {p[0], p[1]});
    const auto tanh = exact(FunctionId::ctanh, {p[0], p[1]});
    const auto power = exact(FunctionId::cpow, {p[0], p[1], "0.5", "1.25"});
    mpc_t z, w, r;
    mpc_init2(z, bits);
    mpc_init2(w, bits);
    mpc_init2(r, bits);
    mpc_set_fr_fr(z, a[0], a[1], MPC_RNDNN);
    mpc_tan(r, z, MPC_RNDNN);
    expect_close(tan[0], mpc_realref(r), bits - 3, "tan re");
    expect_close(tan[1], mpc_imagref(r), bits - 3, "tan im");
    mpc_tanh(r, z, MPC_RNDNN);
    expect_close(tanh[0], mpc_realref(r), bits - 3, "tanh re");
    expect_close(tanh[1], mpc_imagref(r), bits - 3, "tanh im");
    mpc_set_d_d(w, 0.5, 1.25, MPC_RNDNN);
    mpc_pow(r, z, w, MPC_RNDNN);
    expect_close(power[0], mpc_realref(r), bits - 3, "pow re");
    expect_close(power[1], mpc_imagref(r), bits - 3, "pow im");
    mpc_clear(z);
    mpc_clear(w);
    mpc_clear(r);
  }
}

// Lindemann and Weierstrass: off the axes no part is a binary number, however close it comes to one.
TEST(Oracle, PartsOfElementaryComplexFunctionsAreTranscendental) {
  std::vector<MpfrValue> args;
  for (const double x : {0x1p-300, -0x1p-400}) {
    args.emplace_back(53);
    mpfr_set_d(args.back(), x, MPFR_RNDN);
  }
  for (const FunctionId id :
       {FunctionId::csin, FunctionId::ccos, FunctionId::ctan, FunctionId::csinh, FunctionId::ccosh,
        FunctionId::ctanh, FunctionId::casin, FunctionId::cacos, FunctionId::catan, FunctionId::casinh,
        FunctionId::cacosh, FunctionId::catanh, FunctionId::cexp, FunctionId::cpolar}) {
    std::vector<MpfrValue> out;
    out.emplace_back(80);
    out.emplace_back(80);
    const ExactParts parts = exact_value(info_of(id), args, out);
    EXPECT_EQ(parts[0], Exactness::rounded) << info_of(id).name;
    EXPECT_EQ(parts[1], Exactness::rounded) << info_of(id).name;
    mpfr_set_zero(args[1], 1);
    const ExactParts on_axis = exact_value(info_of(id), args, out);
    EXPECT_TRUE(mpfr_zero_p(out[1].get()) == 0 || on_axis[1] != Exactness::rounded) << info_of(id).name;
    mpfr_set_d(args[1], -0x1p-400, MPFR_RNDN);
  }
}

TEST(Oracle, SpecialValuesFollowC99) {
  const auto is = [](FunctionId id, std::initializer_list<const char*> args, const char* wanted) {
    const auto got = exact(id, args);
    const auto want = vector({wanted});
    const bool same = (mpfr_nan_p(got[0].get()) && mpfr_nan_p(want[0].get())) ||
                      (mpfr_equal_p(got[0].get(), want[0].get()) &&
                       mpfr_signbit(got[0].get()) == mpfr_signbit(want[0].get()));
    EXPECT_TRUE(same) << info_of(id).name << " " << *args.begin();
  };
  is(FunctionId::pow, {"1", "@NaN@"}, "1");
  is(FunctionId::pow, {"@NaN@", "0"}, "1");
  is(FunctionId::hypot, {"@Inf@", "@NaN@"}, "@Inf@");
  is(FunctionId::tgamma, {"-0"}, "-@Inf@");
  is(FunctionId::tgamma, {"-3"}, "@NaN@");
  is(FunctionId::lgamma, {"-3"}, "@Inf@");
  is(FunctionId::logb, {"0"}, "-@Inf@");
  is(FunctionId::logb, {"-0.75"}, "-1");
  is(FunctionId::atan2, {"-0", "-1"},
     "-3."
     "1415926535897932384626433832795028841971693993751058209749445923078164062862089986280348253421170679821"
     "4808651");
}

TEST(Condition, MatchesClosedForms) {
  const auto condition = [](FunctionId id, std::initializer_list<const char*> args) {
    return condition_number(info_of(id), vector(args), 0, 53);
  };
  EXPECT_NEAR(condition(FunctionId::exp, {"7"}), 7, 1e-12);
  EXPECT_NEAR(condition(FunctionId::log, {"2"}), 1 / std::log(2.0), 1e-12);
  EXPECT_NEAR(condition(FunctionId::sqrt, {"5"}), 0.5, 1e-12);
  EXPECT_NEAR(condition(FunctionId::sub, {"1", "0.75"}), 7, 1e-12) << "(|x| + |y|) / |x - y|";
  EXPECT_EQ(condition(FunctionId::log, {"1"}), HUGE_VAL) << "a zero";
  EXPECT_TRUE(std::isnan(condition(FunctionId::log, {"-1"})));
  EXPECT_EQ(condition(FunctionId::acos, {"1"}), HUGE_VAL) << "x = 1: one-sided, f is zero";
}

// The engine asks for the number itself only where the bound says that it may matter.
TEST(Condition, BoundsFromDerivativesLieBelowAndClose) {
  struct Case {
    FunctionId id;
    std::initializer_list<const char*> args;
  };
  for (const Case& c : {Case{FunctionId::add, {"1", "-0.75"}}, Case{FunctionId::sub, {"3", "2.875"}},
                        Case{FunctionId::sqrt, {"5"}}, Case{FunctionId::mul, {"3", "7"}},
                        Case{FunctionId::fma, {"3", "5", "-14.5"}}, Case{FunctionId::exp, {"7.5"}},
                        Case{FunctionId::sin, {"3.125"}}, Case{FunctionId::log, {"1.0625"}},
                        Case{FunctionId::tgamma, {"9.5"}}}) {
    const FunctionInfo& f = info_of(c.id);
    const auto args = vector(c.args);
    std::vector<long double> rounded;
    rounded.reserve(args.size());
    for (const MpfrValue& a : args) rounded.push_back(mpfr_get_ld(a, MPFR_RNDN));
    const long double value = mpfr_get_ld(exact(c.id, c.args)[0], MPFR_RNDN);
    const double bound = condition_lower_bound(f, rounded.data(), value, 0);
    const double condition = condition_number(f, args, 0, 53);
    EXPECT_LE(bound, condition) << f.name;
    EXPECT_GT(bound, 0.99 * condition) << f.name;
  }
}

TEST(Oracle, LaguerrePolynomialsAtInfinitiesAreTheirLeadingTerms) {
  const auto at = [](const char* n, const char* x) {
    return mpfr_get_d(exact(FunctionId::laguerre, {n, "1", x})[0], MPFR_RNDN);
  };
  EXPECT_EQ(at("0", "@Inf@"), 1);
  EXPECT_EQ(at("3", "@Inf@"), -HUGE_VAL);
  EXPECT_EQ(at("2", "@Inf@"), HUGE_VAL);
  EXPECT_EQ(at("3", "-@Inf@"), HUGE_VAL);
  EXPECT_TRUE(std::isnan(at("3", "@NaN@")));
}

// Rounded to 250 bits they look like numbers that they are not.
TEST(Oracle, LaguerrePolynomialsTellWhatTheyAreNot) {
  const auto exactness = [](const char* n, const char* m, const char* x) {
    std::vector<MpfrValue> out;
    out.emplace_back(bits);
    return exact_value(info_of(FunctionId::laguerre), vector({n, m, x}), out)[0];
  };
  EXPECT_EQ(exactness("42", "2", "-0x1.eaa764e86cd6ep-439"), Exactness::rounded) << "946 and 2^-430";
  EXPECT_EQ(exactness("1", "80", "0x1.f27e3617d7e4cp+401"), Exactness::rounded) << "81 less 2^401";
  EXPECT_EQ(exactness("3", "0", "0.5"), Exactness::rounded) << "-7/48";
  EXPECT_FALSE(is_rounded(exactness("1", "80", "0x1p-40")));
  EXPECT_FALSE(is_rounded(exactness("2", "3", "0.5"))) << "7.625";
  EXPECT_EQ(exactness("0", "5", "0x1p-900"), Exactness::exact);
}

TEST(Oracle, ComplexPowersNextToTheAxesKeepTheirSmallPart) {
  // (-1)^(1 + i e) = -exp(-pi e), exactly real.
  const auto turn = exact(FunctionId::cpow, {"-1", "0", "1", "0x1p-1074"});
  EXPECT_TRUE(mpfr_zero_p(turn[1].get()));
  EXPECT_LT(mpfr_sgn(turn[0].get()), 0);
  // i^(2^40) = 1.
  const auto whole = exact(FunctionId::cpow, {"0", "1", "0x1p+40", "0"});
  EXPECT_TRUE(mpfr_zero_p(whole[1].get()));
  EXPECT_EQ(mpfr_cmp_ui(whole[0].get(), 1), 0);
  // (-x)^(1 + i e) with x = 1 + 2^-52: the imaginary part is -x sin(e ln x), 1126 bits below the modulus.
  const auto close = exact(FunctionId::cpow, {"-0x1.0000000000001p+0", "0", "1", "0x1p-1074"});
  const auto x = vector({"0x1.0000000000001p+0"});
  MpfrValue want(bits);
  mpfr_log(want, x[0], MPFR_RNDN);
  mpfr_mul_2si(want, want, -1074, MPFR_RNDN);
  mpfr_mul(want, want, x[0], MPFR_RNDN);
  mpfr_neg(want, want, MPFR_RNDN);
  expect_close(close[1], want, 250, "cancelling angle");
}

}  // namespace
}  // namespace ulpgate
