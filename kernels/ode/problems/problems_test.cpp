// The exact solutions against each other: their equation, what they conserve, closed values, Boost.Math.
#include "kernels/ode/problems/problems.hpp"

#include <gtest/gtest.h>

#include <boost/math/special_functions/ellint_1.hpp>
#include <boost/math/special_functions/jacobi_elliptic.hpp>

#include "reference/text/literal.hpp"

namespace ulpgate::ode {
namespace {

using Real = MpfrReal<62>;
using Fine = MpfrReal<150>;

const std::vector<std::string_view> kTimes = {"0.1", "1", "-2.7", "11", "100.3"};

TEST(ExactSolutions, StartWhereTheProblemStarts) {
  for (const auto& solved : standard_problems<Real>()) {
    EXPECT_EQ(solved.exact(Real(0)), solved.problem.start) << solved.name;
  }
}

// Central differences with h = 1e-40: h^2 for the truncation, 1e-150 / h for the rounding.
TEST(ExactSolutions, MeetTheirEquation) {
  const auto h = real<Fine>("1e-40");
  for (const auto& solved : standard_problems<Fine>()) {
    for (const std::string_view text : kTimes) {
      const auto t = real<Fine>(text);
      const std::vector<Fine> y = solved.exact(t);
      const std::vector<Fine> after = solved.exact(Fine(t + h));
      const std::vector<Fine> before = solved.exact(Fine(t - h));
      std::vector<Fine> slope(y.size());
      solved.problem.slope(t, y, slope);
      for (std::size_t i = 0; i < y.size(); ++i) {
        EXPECT_LT(abs((after[i] - before[i]) / (2 * h) - slope[i]), real<Fine>("1e-76"))
            << solved.name << " component " << i << " at t = " << text;
      }
    }
  }
}

TEST(ExactSolutions, ConserveTheirEnergy) {
  for (const auto& solved : standard_problems<Real>()) {
    const Real start = solved.energy(solved.problem.start);
    for (const std::string_view text : kTimes) {
      EXPECT_LT(abs(solved.energy(solved.exact(real<Real>(text))) - start),
                32 * std::numeric_limits<Real>::epsilon())
          << solved.name << " at t = " << text;
    }
  }
}

TEST(ExactSolutions, ConserveAngularMomentum) {
  const auto body = rigid_body<Real>({Real(1), Real(2), Real(3)}, Real(1), Real(1));
  const auto ellipse = kepler(Real(Real(5) / 4));
  for (const std::string_view text : kTimes) {
    const auto w = body.exact(real<Real>(text));
    EXPECT_LT(abs(w[0] * w[0] + 4 * w[1] * w[1] + 9 * w[2] * w[2] - 10),
              64 * std::numeric_limits<Real>::epsilon());
    const auto y = ellipse.exact(real<Real>(text));
    EXPECT_LT(abs(y[0] * y[3] - y[1] * y[2] - Real(5) / 4), 8 * std::numeric_limits<Real>::epsilon());
  }
}

void expect_close(const std::vector<Real>& got, const std::vector<Real>& wanted, const char* why) {
  ASSERT_EQ(got.size(), wanted.size());
  for (std::size_t i = 0; i < got.size(); ++i) {
    EXPECT_LT(abs(got[i] - wanted[i]), 16 * std::numeric_limits<Real>::epsilon()) << why << ", " << i;
  }
}

TEST(ExactSolutions, HaveTheirClosedValues) {
  const Real pi = acos(Real(-1));
  const Real half = Real(1) / 2;
  expect_close(harmonic_oscillator(Real(2)).exact(Real(pi / 2)), {Real(-1), Real(0)}, "half a period");
  // k = 1/2 swings to 2 asin(1/2) = pi/3 at the quarter period.
  expect_close(pendulum(Real(1), half).exact(complete_elliptic_k(half)), {Real(pi / 3), Real(0)},
               "turning point");
  // e = 9/16, a = 16/7: the period 2 pi a^(3/2), the aphelion -a (1 + e) = -25/7 with the speed
  // (1/1.25)(7/16).
  const Real period = 2 * pi * sqrt(Real(4096) / 343);
  const auto ellipse = kepler(Real(Real(5) / 4));
  expect_close(ellipse.exact(Real(period / 2)), {Real(Real(-25) / 7), Real(0), Real(0), Real(Real(-7) / 20)},
               "aphelion");
  expect_close(ellipse.exact(period), {Real(1), Real(0), Real(0), Real(Real(5) / 4)}, "one revolution");
  // I = (1, 2, 3), w = (1, 0, 1): k^2 = 1/3, rate 1; at K: (0, 1, sqrt(2/3)).
  const auto body = rigid_body<Real>({Real(1), Real(2), Real(3)}, Real(1), Real(1));
  const Real k = sqrt(Real(1) / 3);
  expect_close(body.exact(complete_elliptic_k(k)), {Real(0), Real(1), sqrt(Real(2) / 3)}, "quarter period");
}

TEST(JacobiElliptic, HasItsClosedValues) {
  const Real k = real<Real>("0.8");
  const Real quarter = complete_elliptic_k(k);
  const auto f = jacobi_elliptic<Real>(quarter / 2, k);
  const Real tolerance = 256 * std::numeric_limits<Real>::epsilon();
  // M. Abramowitz, I. A. Stegun (1964), 16.5, with k' = 0.6.
  const Real complement = real<Real>("0.6");
  EXPECT_LT(abs(f.sn - 1 / sqrt(1 + complement)), tolerance);
  EXPECT_LT(abs(f.cn - sqrt(complement / (1 + complement))), tolerance);
  EXPECT_LT(abs(f.dn - sqrt(complement)), tolerance);
  EXPECT_LT(abs(jacobi_elliptic<Real>(Real(1), Real(0)).sn - sin(Real(1))), tolerance);
  // K(1/sqrt 2) = gamma(1/4)^2 / (4 sqrt pi), the lemniscatic case.
  const Real pi = acos(Real(-1));
  const Real gamma = tgamma(Real(Real(1) / 4));
  EXPECT_LT(abs(complete_elliptic_k(Real(1 / sqrt(Real(2)))) - gamma * gamma / (4 * sqrt(pi))), tolerance);
}

template <class T>
void agrees_with_boost(int lost_bits) {
  const T tolerance = ldexp(std::numeric_limits<T>::epsilon(), lost_bits);
  for (const char* k_text : {"0", "0.1", "0.5", "0.9", "0.999"}) {
    const T k = real<T>(k_text);
    EXPECT_LT(abs(T(complete_elliptic_k(k) - boost::math::ellint_1(k))), 8 * tolerance) << k_text;
    for (const char* u_text : {"-3.1", "0.001", "0.7", "2", "9.5"}) {
      const T u = real<T>(u_text);
      T cn;
      T dn;
      const T sn = boost::math::jacobi_elliptic(k, u, &cn, &dn);
      const JacobiElliptic<T> got = jacobi_elliptic(u, k);
      EXPECT_LT(abs(T(got.sn - sn)), tolerance) << "sn(" << u_text << ", " << k_text << ")";
      EXPECT_LT(abs(T(got.cn - cn)), tolerance) << "cn(" << u_text << ", " << k_text << ")";
      EXPECT_LT(abs(T(got.dn - dn)), tolerance) << "dn(" << u_text << ", " << k_text << ")";
    }
  }
}

TEST(JacobiElliptic, AgreesWithBoostInDouble) {
  agrees_with_boost<double>(12);
}
TEST(JacobiElliptic, AgreesWithBoostAt62Digits) {
  agrees_with_boost<Real>(12);
}

TEST(Problems, RejectParametersWithoutASolution) {
  EXPECT_THROW((void)harmonic_oscillator(0.0), std::invalid_argument);
  EXPECT_THROW((void)pendulum(1.0, 1.0), std::invalid_argument);
  EXPECT_THROW((void)pendulum(-1.0, 0.5), std::invalid_argument);
  EXPECT_NO_THROW((void)kepler(1.0)) << "a circle";
  EXPECT_THROW((void)kepler(1.5), std::invalid_argument);
  EXPECT_THROW((void)kepler(0.5), std::invalid_argument);
  EXPECT_THROW((void)kepler(std::numeric_limits<double>::quiet_NaN()), std::invalid_argument);
  EXPECT_THROW((void)rigid_body<double>({2, 1, 3}, 1, 1), std::invalid_argument);
  EXPECT_THROW((void)rigid_body<double>({1, 2, 3}, 4, 1), std::invalid_argument);
  EXPECT_THROW((void)jacobi_elliptic(1.0, 1.0), std::invalid_argument);
  EXPECT_THROW((void)complete_elliptic_k(-0.1), std::invalid_argument);
}

}  // namespace
}  // namespace ulpgate::ode
