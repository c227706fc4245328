// Steppers that estimate their error: orders of step and estimate, stiffness, and the control of the step.
#include <gtest/gtest.h>

#include <cmath>

#include "kernels/ode/error_control/adaptive.hpp"
#include "kernels/ode/error_control/gragg_stepper.hpp"
#include "kernels/ode/error_control/rosenbrock.hpp"
#include "kernels/ode/integrators/make_stepper.hpp"
#include "kernels/ode/problems/initial_value_cases.hpp"
#include "kernels/ode/problems/problems.hpp"

namespace ulpgate::ode {
namespace {

using Wide = MpfrReal<62>;

template <RealType Real>
const InitialValueCase<Real>& case_of(const std::vector<InitialValueCase<Real>>& cases,
                                      std::string_view name) {
  for (const auto& c : cases) {
    if (c.name == name) return c;
  }
  throw std::invalid_argument("no case");
}

// B(p): sum b c^(k-1) = 1/k, which makes a quadrature of order p; C(s): sum_j a_ij c_j^(k-1) = c_i^k / k,
// which makes a collocation (E. Hairer, S. P. Norsett, G. Wanner, II.7).
TEST(Collocation, TableauxFulfilTheSimplifyingAssumptions) {
  const Wide floor("1e-58");
  for (const CollocationNodes nodes : {CollocationNodes::gauss, CollocationNodes::radau}) {
    for (int stages = 2; stages <= 13; ++stages) {
      const auto& t = collocation_tableau<Wide>(nodes, stages);
      const int order = nodes == CollocationNodes::gauss ? 2 * stages : 2 * stages - 1;
      for (int k = 1; k <= order; ++k) {
        Wide sum(0);
        for (std::size_t i = 0; i < t.c.size(); ++i) sum += t.b[i] * pow(t.c[i], k - 1);
        EXPECT_LT(abs(Wide(sum - Wide(1) / k)), floor) << stages << " stages, B(" << k << ")";
      }
      for (int k = 1; k <= stages; ++k) {
        for (std::size_t i = 0; i < t.c.size(); ++i) {
          Wide sum(0);
          for (std::size_t j = 0; j < t.c.size(); ++j) sum += t.a[i][j] * pow(t.c[j], k - 1);
          EXPECT_LT(abs(Wide(sum - pow(t.c[i], k) / k)), floor) << stages << " stages, C(" << k << ")";
        }
      }
      if (nodes == CollocationNodes::radau) {
        EXPECT_EQ(t.c.back(), Wide(1)) << stages;
      }
    }
  }
}

// Radau IIA of two stages: c = (1/3, 1), a = (5/12, -1/12; 3/4, 1/4).
TEST(Collocation, RadauOfTwoStagesIsThePublishedOne) {
  const auto& t = radau_tableau<double>(2);
  EXPECT_DOUBLE_EQ(t.c[0], 1.0 / 3);
  EXPECT_DOUBLE_EQ(t.a[0][0], 5.0 / 12);
  EXPECT_DOUBLE_EQ(t.a[0][1], -1.0 / 12);
  EXPECT_DOUBLE_EQ(t.a[1][0], 3.0 / 4);
  EXPECT_DOUBLE_EQ(t.a[1][1], 1.0 / 4);
}

// Each Jacobian against differences of the slope, in a precision where those are good to 25 digits.
TEST(InitialValueCases, JacobiansAreTheDerivativesOfTheSlopes) {
  for (const auto& c : initial_value_cases<Wide>()) {
    // A point that is not special: a little off the start.
    std::vector<Wide> y = c.problem.start;
    const std::size_t n = y.size();
    for (std::size_t i = 0; i < n; ++i) y[i] += Wide(static_cast<int>(i) + 1) / 1000;
    std::vector<Wide> exact(n * n);
    c.problem.jacobian(Wide(0), y, exact);
    Wide size(0);
    for (const Wide& x : exact) size = abs(x) > size ? Wide(abs(x)) : size;
    const Wide step = ldexp(Wide(1), -70);
    std::vector<Wide> up(n);
    std::vector<Wide> down(n);
    for (std::size_t j = 0; j < n; ++j) {
      std::vector<Wide> moved = y;
      moved[j] = y[j] + step;
      c.problem.slope(Wide(0), moved, up);
      moved[j] = y[j] - step;
      c.problem.slope(Wide(0), moved, down);
      for (std::size_t i = 0; i < n; ++i) {
        const Wide difference = (up[i] - down[i]) / (2 * step);
        EXPECT_LT(abs(Wide(difference - exact[i * n + j])), size * Wide("1e-25")) << c.name << " " << i << j;
      }
    }
  }
}

// Along steps of extrapolation so short that their own error is below the bound.
TEST(InitialValueCases, SlopesKeepTheInvariants) {
  for (const auto& c : initial_value_cases<Wide>()) {
    if (!c.invariant) continue;
    const std::size_t n = c.problem.start.size();
    std::vector<Wide> slope(n);
    std::vector<Wide> y = c.problem.start;
    // Away from the special start, along the flow.
    GraggStepper<Wide> stepper(c.problem, 8);
    for (int i = 0; i < 20; ++i) stepper.advance(Wide(0), Wide(1) / 1000000);
    const Wide start = c.invariant(c.problem.start);
    const Wide moved = abs(Wide(c.invariant(stepper.state()) - start));
    EXPECT_LT(moved, Wide("1e-40") * (1 + abs(start))) << c.name;
  }
}

template <class Make>
double measured_order(Make&& make, bool of_estimate) {
  const auto solved = pendulum(Wide(1), Wide(Wide(1) / 2));
  std::vector<double> errors;
  for (const int steps : {32, 64}) {
    const auto stepper = make(solved.problem);
    const Wide h = Wide(1) / steps;
    if (of_estimate) {
      EXPECT_TRUE(stepper->attempt(Wide(0), h));
      Wide largest(0);
      for (const Wide& x : stepper->error()) largest = abs(x) > largest ? Wide(abs(x)) : largest;
      errors.push_back(static_cast<double>(largest));
    } else {
      for (int i = 0; i < steps; ++i) stepper->advance(i * h, h);
      errors.push_back(static_cast<double>(Wide(abs(Wide(stepper->state()[0] - solved.exact(Wide(1))[0])))));
    }
  }
  return std::log2(errors[0] / errors[1]);
}

TEST(ErrorSteppers, AreOfTheOrdersTheyClaim) {
  for (const int stages : {2, 3, 5}) {
    const auto radau = [stages](const Problem<Wide>& p) {
      return make_newton_stepper<Wide>(p, CollocationNodes::radau, stages);
    };
    EXPECT_NEAR(measured_order(radau, false), 2 * stages - 1, 0.1) << stages;
    EXPECT_NEAR(measured_order(radau, true), stages + 1, 0.25) << stages;
  }
  const auto gauss = [](const Problem<Wide>& p) {
    return make_newton_stepper<Wide>(p, CollocationNodes::gauss, 3);
  };
  EXPECT_NEAR(measured_order(gauss, false), 6, 0.1);
  const auto rodas = [](const Problem<Wide>& p) { return std::make_unique<RosenbrockStepper<Wide>>(p); };
  EXPECT_NEAR(measured_order(rodas, false), 3, 0.1);
  EXPECT_NEAR(measured_order(rodas, true), 3, 0.25);
  for (const int columns : {3, 5}) {
    const auto gragg = [columns](const Problem<Wide>& p) {
      return std::make_unique<GraggStepper<Wide>>(p, columns);
    };
    EXPECT_NEAR(measured_order(gragg, false), 2 * columns, 0.1) << columns;
    EXPECT_NEAR(measured_order(gragg, true), 2 * columns - 1, 0.25) << columns;
  }
}

// y' = -1e6 (y - cos t) has no Jacobian here: Newton's iteration makes its own by differences.
TEST(NewtonStepper, TakesLongStepsOnAStiffProblemWithoutItsJacobian) {
  const auto problem =
      first_order_problem<double>({0}, [](const double& t, std::span<const double> y, std::span<double> out) {
        out[0] = -1e6 * (y[0] - std::cos(t));
      });
  const auto stepper = make_newton_stepper<double>(problem, CollocationNodes::radau, 3);
  for (int i = 0; i < 10; ++i) stepper->advance(0.1 * i, 0.1);
  EXPECT_NEAR(stepper->state()[0], std::cos(1.0), 1e-6);
}

// Roundings of r - 1 of the stretched spring, times omega^2 h, move the velocity by 4000 roundoffs: no
// correction falls below that, and the step is as good as the type can make it.
template <RealType Real>
double pendulum_error_in_roundoffs() {
  constexpr int steps = 400;
  const auto end_of = []<RealType T>(const T&) {
    const auto cases = initial_value_cases<T>();
    const auto stepper =
        make_newton_stepper<T>(case_of(cases, "stiff_pendulum_1000").problem, CollocationNodes::gauss, 4);
    const T h = T(1) / 400;
    for (int i = 0; i < steps; ++i) stepper->advance(static_cast<T>(i) * h, h);
    return std::vector<T>(stepper->state().begin(), stepper->state().end());
  };
  const std::vector<Real> own = end_of(Real(0));
  const std::vector<Wide> exact = end_of(Wide(0));
  double largest = 0;
  for (std::size_t d = 0; d < own.size(); ++d)
    largest = std::max(largest, std::abs(static_cast<double>(Wide(Wide(own[d]) - exact[d]))));
  return largest / static_cast<double>(std::numeric_limits<Real>::epsilon());
}

TEST(NewtonStepper, SettlesWhereOnlyRoundingsOfTheEquationsAreLeft) {
  // The velocity at the lowest point is about sqrt 2; a step's noise is 4000 roundoffs and 400 add up.
  EXPECT_LT(pendulum_error_in_roundoffs<float>(), 1e5);
  EXPECT_LT(pendulum_error_in_roundoffs<double>(), 1e5);
  EXPECT_LT(pendulum_error_in_roundoffs<long double>(), 1e5);
}

// Steps of a type that decomposes in long double are those of its own digits: twice as many change nothing.
template <RealType Real>
std::vector<Wide> stiff_end(const char* name, const char* step) {
  const auto cases = initial_value_cases<Real>();
  const auto stepper = make_newton_stepper<Real>(case_of(cases, name).problem, CollocationNodes::radau, 5);
  Real t(0);
  for (int i = 0; i < 12; ++i) {
    const Real h = real<Real>(step) * static_cast<Real>(1 << i);
    stepper->advance(t, h);
    t += h;
  }
  std::vector<Wide> end;
  for (const Real& x : stepper->state()) end.push_back(static_cast<Wide>(x));
  return end;
}

TEST(NewtonStepper, GivesAllDigitsOfATypeWhoseDecompositionsAreNarrow) {
  for (const auto& [name, step] : {std::pair{"robertson", "1e-5"}, std::pair{"hires", "1e-3"}}) {
    const std::vector<Wide> own = stiff_end<Wide>(name, step);
    const std::vector<Wide> wider = stiff_end<MpfrReal<150>>(name, step);
    for (std::size_t d = 0; d < own.size(); ++d) {
      const auto relative = static_cast<double>(Wide(abs(Wide(own[d] - wider[d])) / abs(wider[d])));
      EXPECT_LT(relative, 1e-54) << name << " " << d;
    }
  }
}

// Stage equations without a solution: z = h/2 (1 + z^2) beyond h = 1, and a slope that jumps back over where
// the solution would have to be.
TEST(NewtonStepper, TakesNothingForASolutionWhereThereIsNone) {
  const auto escaping = autonomous_problem<float>(
      {0}, []<class T>(std::span<const T> y, std::span<T> out) { out[0] = float(1) + y[0] * y[0]; });
  const auto midpoint = make_newton_stepper<float>(escaping, CollocationNodes::gauss, 1);
  EXPECT_TRUE(midpoint->attempt(0, 0.5F));
  for (const float h : {1.5F, 4.F, 1e3F, 1e6F, 1e12F}) EXPECT_FALSE(midpoint->attempt(0, h)) << h;
  const auto jumping =
      first_order_problem<float>({0}, [](const float&, std::span<const float> y, std::span<float> out) {
        out[0] = y[0] < 0.25F ? 1.F : -1.F;
      });
  for (const int stages : {1, 2, 3}) {
    for (const CollocationNodes nodes : {CollocationNodes::gauss, CollocationNodes::radau}) {
      if (stages == 1 && nodes == CollocationNodes::radau) continue;
      const auto stepper = make_newton_stepper<float>(jumping, nodes, stages);
      EXPECT_TRUE(stepper->attempt(0, 0.125F)) << stages;
      EXPECT_FALSE(stepper->attempt(0, 2)) << stages;
    }
  }
}

TEST(StepControl, FollowsRobertsonToItsEndAndRefusesWhatIsHopeless) {
  const auto cases = initial_value_cases<double>();
  const auto& robertson = case_of(cases, "robertson");
  const auto radau = make_newton_stepper<double>(robertson.problem, CollocationNodes::radau, 3);
  const auto run = integrate_adaptively<double>(*radau, 1e11, 1e-6, {1e-8, 0, 100000});
  EXPECT_EQ(run.end, AdaptiveEnd::reached);
  EXPECT_LT(run.steps.size(), 2000U);
  EXPECT_NEAR(radau->state()[0] / 2.0833401497012942e-08, 1, 1e-5);
  // An explicit method would need 1e15 steps: it ends by its budget instead.
  GraggStepper<double> explicit_one(robertson.problem, 4);
  const auto hopeless = integrate_adaptively<double>(explicit_one, 1e11, 1e-6, {1e-8, 0, 20000});
  EXPECT_EQ(hopeless.end, AdaptiveEnd::too_many_attempts);
  EXPECT_EQ(hopeless.attempts, 20001U);
  EXPECT_THROW((void)integrate_adaptively<double>(*radau, 0.0, 1e-6, {}), std::invalid_argument);
  EXPECT_THROW((void)integrate_adaptively<double>(*radau, 1.0, -1.0, {}), std::invalid_argument);
}

// x' = x^2 leaves the numbers at t = 1: the steps shrink until time stands still.
TEST(StepControl, EndsAtASingularity) {
  const auto problem = autonomous_problem<double>(
      {1}, []<class T>(std::span<const T> y, std::span<T> out) { out[0] = y[0] * y[0]; });
  GraggStepper<double> stepper(problem, 4);
  const auto run = integrate_adaptively<double>(stepper, 2.0, 1e-3, {1e-10, 0, 1'000'000});
  EXPECT_EQ(run.end, AdaptiveEnd::step_vanished);
}

TEST(Rosenbrock, RefusesAProblemWithoutItsJacobian) {
  const auto problem = first_order_problem<double>(
      {1}, [](const double&, std::span<const double> y, std::span<double> out) { out[0] = -y[0]; });
  EXPECT_THROW(RosenbrockStepper<double>{problem}, std::invalid_argument);
}

}  // namespace
}  // namespace ulpgate::ode
