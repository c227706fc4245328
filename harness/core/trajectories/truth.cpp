// true_solution().
#include "harness/core/trajectories/truth.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>

#include "harness/core/trajectories/truth_integration.hpp"
#include "reference/text/text.hpp"

namespace ulpgate {

namespace {

using truth::Setting;

template <RealType Real>
[[nodiscard]] std::vector<TrueValue> settled(std::string_view problem, std::string_view end, int digits,
                                             const ode::StopFlag& stop) {
  using std::abs;
  const auto p = truth::prepare<Real>(problem, end);
  const std::vector<Real> at{ode::end_time<Real>(end)};
  // Radau's estimate is of a far lower order than its error, the extrapolation's is of nearly the same.
  double exponent = p.stiff ? 0.6 * digits : digits + 6.0;
  const int order = p.stiff ? 9 : 12 + digits / 10;
  double worst = 0;
  for (int round = 0; round < 8; ++round) {
    const Setting coarse{order, std::pow(10.0, -exponent)};
    const Setting fine{p.stiff ? order + 4 : order + 3, std::pow(10.0, -exponent - 2)};
    const std::vector<Real> a = truth::integrated<Real>(p, at, coarse, digits, stop).front();
    const std::vector<Real> b = truth::integrated<Real>(p, at, fine, digits, stop).front();
    std::vector<TrueValue> values;
    worst = HUGE_VAL;
    for (std::size_t i = 0; i < a.size(); ++i) {
      const double agreed = truth::agreement<Real>(a[i], b[i], abs(b[i]));
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
