// true_solution().
#include "harness/core/trajectories/truth.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>

#include "kernels/ode/error_control/adaptive.hpp"
#include "kernels/ode/error_control/gragg_stepper.hpp"
#include "kernels/ode/error_control/newton_stepper.hpp"
#include "kernels/ode/problems/e5_logarithmic.hpp"
#include "kernels/ode/problems/initial_value_cases.hpp"
#include "reference/text/text.hpp"

namespace ulpgate {

namespace {

// How one integration is made: stages of Radau IIA or columns of the extrapolation, and the tolerance of a
// step.
struct Setting {
  int order;
  double tolerance;
};

template <RealType Real>
struct Prepared {
  ode::Problem<Real> problem;
  bool stiff;
  // The components of the case, of a state of `problem`.
  std::function<std::vector<Real>(std::span<const Real>)> components;
};

template <RealType Real>
[[nodiscard]] Prepared<Real> prepare(std::string_view name, std::string_view end) {
  for (auto& c : ode::initial_value_cases<Real>()) {
    if (c.name != name) continue;
    if (std::ranges::find(c.ends, end) == c.ends.end())
      throw std::invalid_argument("'" + std::string(end) + "' is no end of " + c.name);
    if (name == "e5") return {ode::e5_logarithmic<Real>(), true, ode::e5_components<Real>};
    return {c.problem, c.stiff,
            [](std::span<const Real> y) { return std::vector<Real>(y.begin(), y.end()); }};
  }
  throw std::invalid_argument("no initial value problem is called '" + std::string(name) + "'");
}

template <RealType Real>
[[nodiscard]] std::vector<Real> integrated(const Prepared<Real>& p, std::string_view end,
                                           const Setting& setting, int digits, const ode::StopFlag& stop) {
  std::unique_ptr<ode::ErrorStepper<Real>> stepper;
  if (p.stiff) {
    auto radau =
        std::make_unique<ode::NewtonStepper<Real>>(p.problem, ode::CollocationNodes::radau, setting.order);
    radau->set_newton_tolerance(pow(Real(10), -(digits + 12)));
    stepper = std::move(radau);
  } else {
    stepper = std::make_unique<ode::GraggStepper<Real>>(p.problem, setting.order);
  }
  stepper->set_stop(stop);
  // Components of an orbit pass through 0, where none of their digits can be asked for; concentrations do
  // not.
  const ode::StepControl control{setting.tolerance, p.stiff ? 0 : setting.tolerance, 4'000'000};
  const auto run =
      ode::integrate_adaptively<Real>(*stepper, ode::end_time<Real>(end), real<Real>("1e-8"), control, stop);
  if (run.end != ode::AdaptiveEnd::reached) throw std::runtime_error(std::string(to_string(run.end)));
  return p.components(stepper->state());
}

// Digits on which two numbers agree, relative to b.
template <RealType Real>
[[nodiscard]] double agreement(const Real& a, const Real& b) {
  if (a == b) return HUGE_VAL;
  if (b == 0) return 0;
  return -static_cast<double>(Real(log10(Real(abs(Real(a - b)) / abs(b)))));
}

template <RealType Real>
[[nodiscard]] std::vector<TrueValue> settled(std::string_view problem, std::string_view end, int digits,
                                             const ode::StopFlag& stop) {
  const Prepared<Real> p = prepare<Real>(problem, end);
  // Radau's estimate is of a far lower order than its error, the extrapolation's is of nearly the same.
  double exponent = p.stiff ? 0.6 * digits : digits + 6.0;
  const int order = p.stiff ? 9 : 12 + digits / 10;
  double worst = 0;
  for (int round = 0; round < 8; ++round) {
    const Setting coarse{order, std::pow(10.0, -exponent)};
    const Setting fine{p.stiff ? order + 4 : order + 3, std::pow(10.0, -exponent - 2)};
    const std::vector<Real> a = integrated(p, end, coarse, digits, stop);
    const std::vector<Real> b = integrated(p, end, fine, digits, stop);
    std::vector<TrueValue> values;
    worst = HUGE_VAL;
    for (std::size_t i = 0; i < a.size(); ++i) {
      const double agreed = agreement(a[i], b[i]);
      worst = std::min(worst, agreed);
      MpfrValue exact(std::numeric_limits<Real>::digits);
      to_mpfr(exact.get(), b[i]);
      values.push_back({to_decimal(exact.get(), digits), std::min<double>(agreed, digits)});
    }
    // Half a digit more: the last one is rounded.
    if (worst >= digits + 0.5) return values;
    exponent += std::max(p.stiff ? 2.0 : 4.0, digits + 1.5 - worst);
    // Nothing is left of a type's digits for the estimate.
    if (exponent > std::numeric_limits<Real>::digits10 - 8) break;
  }
  throw std::runtime_error("two integrations of " + std::string(problem) + " to t = " + std::string(end) +
                           " agree on " + std::to_string(static_cast<int>(worst)) + " digits only");
}

// One turn leads back to the start.
[[nodiscard]] std::vector<TrueValue> closed_kepler(int digits) {
  using Real = MpfrReal<150>;
  std::vector<TrueValue> values;
  for (const auto& c : ode::initial_value_cases<Real>()) {
    if (c.name != "kepler") continue;
    for (const Real& x : c.problem.start) {
      MpfrValue exact(std::numeric_limits<Real>::digits);
      to_mpfr(exact.get(), x);
      values.push_back({to_decimal(exact.get(), digits), static_cast<double>(digits)});
    }
  }
  return values;
}

}  // namespace

std::vector<TrueValue> true_solution(std::string_view problem, std::string_view end, int digits,
                                     const ode::StopFlag& stop) {
  if (digits < 1 || digits > most_truth_digits)
    throw std::invalid_argument("a true solution has 1 to " + std::to_string(most_truth_digits) + " digits");
  if (problem == "kepler" && end == "2 pi") return closed_kepler(digits);
  // An orbit that closes has components near 0, whose digits are those of a much smaller number.
  const bool wide = digits > 34 || problem == "arenstorf";
  return wide ? settled<MpfrReal<150>>(problem, end, digits, stop)
              : settled<MpfrReal<62>>(problem, end, digits, stop);
}

}  // namespace ulpgate
