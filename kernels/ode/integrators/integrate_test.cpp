// The list of integrators and what integrate() refuses.
#include "kernels/ode/integrators/integrate.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <set>

#include "kernels/ode/problems/problems.hpp"

namespace ulpgate::ode {
namespace {

TEST(Integrators, AreNamedOnceAndCited) {
  std::set<std::string> names;
  for (const IntegratorInfo& info : integrators()) {
    EXPECT_TRUE(names.insert(info.name).second) << info.name;
    EXPECT_FALSE(info.citation.empty()) << info.name;
    EXPECT_EQ(&find_integrator(info.name), &info);
    EXPECT_NE(to_string(info.kind), "unknown");
  }
}

// Evaluations per step as listed: the difference of 11 and 10 steps.
TEST(Integrators, CostWhatTheListSays) {
  for (const IntegratorInfo& info : integrators()) {
    if (!info.evaluations_per_step) continue;
    long calls = 0;
    Problem<double> problem =
        second_order_problem<double>({1}, {0}, [&calls](std::span<const double> q, std::span<double> a) {
          ++calls;
          a[0] = -q[0];
        });
    problem.jacobian = [](const double&, std::span<const double>, std::span<double> out) {
      const std::array<double, 4> rows{0, 1, -1, 0};
      std::ranges::copy(rows, out.begin());
    };
    (void)integrate<double>(info.name, problem, 1, 10);
    const long ten = calls;
    (void)integrate<double>(info.name, problem, 1, 11);
    EXPECT_EQ(calls - 2 * ten, *info.evaluations_per_step) << info.name;
  }
}

// One step of the paper's leapfrog, bit for bit: v = v + dt a, then p = p + v dt.
TEST(Integrators, LeapfrogIsKickThenDrift) {
  const Problem<double> problem = pendulum(1.0, 0.5).problem;
  double q = problem.start[0];
  double v = problem.start[1];
  const double dt = 0.1;
  const auto stepper = make_stepper<double>("leapfrog", problem);
  for (int i = 0; i < 100; ++i) {
    v = v + dt * -std::sin(q);
    q = q + v * dt;
    stepper->advance(i * dt, dt);
    ASSERT_EQ(stepper->state()[0], q);
    ASSERT_EQ(stepper->state()[1], v);
  }
}

// y' = t: only a method that passes the right time to f integrates it.  Euler's takes f at the start of each
// of the seven steps: 9/49 (0 + 1 + ... + 6).
TEST(Integrators, KnowTheTime) {
  const auto problem = first_order_problem<double>(
      {0}, [](const double& t, std::span<const double>, std::span<double> out) { out[0] = t; });
  for (const IntegratorInfo& info : integrators()) {
    if (info.kind == IntegratorKind::splitting || info.kind == IntegratorKind::rosenbrock) continue;
    const double wanted = info.order == 1 ? 27.0 / 7 : 4.5;
    EXPECT_NEAR(integrate<double>(info.name, problem, 3.0, 7)[0], wanted, 1e-14) << info.name;
  }
}

// The message of the exception that `call` throws, empty if none.
template <class Exception, class Call>
std::string thrown(Call&& call) {
  try {
    call();
  } catch (const Exception& e) {
    return e.what();
  }
  return "";
}

TEST(Integrate, RefusesWithAReason) {
  using Bad = std::invalid_argument;
  const Problem<double> swing = pendulum(1.0, 0.5).problem;
  const Problem<double> body = rigid_body<double>({1, 2, 3}, 1, 1).problem;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto run = [](std::string_view name, const Problem<double>& problem, double t_end, long steps) {
    return thrown<Bad>([&] { (void)integrate<double>(name, problem, t_end, steps); });
  };
  EXPECT_EQ(run("pefrl", swing, 1, 0), "integrate: steps must be at least 1");
  EXPECT_EQ(run("pefrl", swing, 1, -3), "integrate: steps must be at least 1");
  EXPECT_EQ(run("pefrl", swing, nan, 1), "integrate: the end of time must be finite");
  EXPECT_EQ(run("pefrl", body, 1, 1), "pefrl integrates q'' = a(q) only; this problem is of first order");
  EXPECT_EQ(run("gauss2", Problem<double>{}, 1, 1), "a problem needs a start and a slope");
  EXPECT_EQ(run("rk5", swing, 1, 1).substr(0, 37), "no integrator 'rk5'; there are leapfr");
  EXPECT_EQ(run("", swing, 1, 1).substr(0, 16), "no integrator ''");
  EXPECT_EQ(run("gauss11", swing, 1, 1).substr(0, 23), "no integrator 'gauss11'");
}

TEST(Integrate, SaysWhenTheStagesDoNotConverge) {
  const auto stiff = harmonic_oscillator(1000.0).problem;
  EXPECT_EQ(thrown<std::runtime_error>([&] { (void)integrate<double>("gauss4", stiff, 1, 1); }),
            "Gauss-Legendre: the stages do not converge at this step size");
}

}  // namespace
}  // namespace ulpgate::ode
