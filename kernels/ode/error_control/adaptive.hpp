// Step control: an ErrorStepper taken to an end of time with steps as large as a tolerance lets them be.
//
// E. Hairer, S. P. Norsett, G. Wanner, Solving Ordinary Differential Equations I (1993), II.4.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string_view>

#include "kernels/ode/stepper/error_stepper.hpp"

namespace ulpgate::ode {

struct StepControl {
  double relative = 1e-6;  // of each component
  double absolute = 0;     // added to it; 0: components are followed however small they grow
  std::uint64_t most_attempts = 1'000'000;
};

enum class AdaptiveEnd {
  reached,
  too_many_attempts,
  step_vanished,  // the time no longer moves: the step is below its last place
};

[[nodiscard]] constexpr std::string_view to_string(AdaptiveEnd end) {
  switch (end) {
    case AdaptiveEnd::reached:
      return "the end was reached";
    case AdaptiveEnd::too_many_attempts:
      return "the steps that the tolerance asks for are too many";
    case AdaptiveEnd::step_vanished:
      return "the step that the tolerance asks for is below the last place of the time";
  }
  return "unknown";
}

template <RealType Real>
struct AdaptiveRun {
  AdaptiveEnd end = AdaptiveEnd::reached;
  std::vector<Real> steps;  // accepted ones
  std::uint64_t attempts = 0;
};

namespace detail {

// The largest estimated error of a component in units of its tolerance; above 1 the step is refused.
template <RealType Real>
[[nodiscard]] double error_in_tolerances(const ErrorStepper<Real>& stepper, const StepControl& control) {
  using std::abs;
  double largest = 0;
  for (std::size_t i = 0; i < stepper.state().size(); ++i) {
    const Real error = abs(stepper.error()[i]);
    if (error == 0) continue;
    const Real size = std::max<Real>(abs(stepper.state()[i]), abs(stepper.candidate()[i]));
    const Real tolerance = static_cast<Real>(control.absolute) + static_cast<Real>(control.relative) * size;
    const double ratio = static_cast<double>(Real(error / tolerance));
    if (!(ratio <= largest)) largest = ratio;
  }
  return largest;
}

}  // namespace detail

// From t = 0 to `end` > 0, from a first step of `first`.  Throws std::invalid_argument where either is not
// positive, and Stopped.
template <RealType Real>
[[nodiscard]] AdaptiveRun<Real> integrate_adaptively(ErrorStepper<Real>& stepper, const Real& end,
                                                     const Real& first, const StepControl& control,
                                                     const StopFlag& stop = {}) {
  if (!(end > 0) || !(first > 0))
    throw std::invalid_argument("step control: the end and the first step must be positive");
  AdaptiveRun<Real> run;
  Real t(0);
  Real h = first < end ? first : end;
  bool refused = false;
  while (true) {
    stop.check();
    if (++run.attempts > control.most_attempts) {
      run.end = AdaptiveEnd::too_many_attempts;
      return run;
    }
    const bool last = t + h >= end;
    const Real tried = last ? Real(end - t) : h;
    if (t + tried == t) {
      run.end = AdaptiveEnd::step_vanished;
      return run;
    }
    double error = std::numeric_limits<double>::infinity();
    if (stepper.attempt(t, tried)) error = detail::error_in_tolerances(stepper, control);
    if (error <= 1) {
      stepper.accept();
      run.steps.push_back(tried);
      if (last) return run;
      t += tried;
    }
    // No growth right behind a refusal; a step without a solution says nothing of its error.
    const double most = refused || error > 1 ? 1.0 : 8.0;
    const double factor =
        std::isfinite(error)
            ? std::clamp(0.9 * std::pow(std::max(error, 1e-300), -1.0 / stepper.error_order()), 0.1, most)
            : 0.25;
    refused = !(error <= 1);
    h = tried * static_cast<Real>(factor);
  }
}

}  // namespace ulpgate::ode
