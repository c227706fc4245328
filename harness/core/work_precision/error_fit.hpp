// The error of an integrator over its step, fitted as max(C dt^p, B sqrt(n) u, D n u).
#pragma once

#include <optional>
#include <string_view>
#include <vector>

namespace ulpgate {

// Time-stepping errs by C dt^p; rounding that is unbiased makes a walk at random of n steps, B sqrt(n) u, and
// rounding that always errs to one side a drift, D n u (D. Brouwer, Astron. J. 46 (1937) 149; E. Hairer, R.
// McLachlan, A. Razakarivony, BIT 48 (2008) 231).
struct FitPoint {
  double dt;
  double steps;  // n, some constant over dt
  double error;  // NaN or infinite where the setting failed
};

enum class ErrorRegime {
  failed,        // no number: the curve is broken here
  exact,         // no error at all: it has no logarithm
  unresolved,    // too coarse for the order to show
  stepping,      // C dt^p
  random_walk,   // B sqrt(n) u
  linear_drift,  // D n u
};
[[nodiscard]] std::string_view to_string(ErrorRegime regime);  // "random walk"

struct ErrorFit {
  std::vector<ErrorRegime> regimes;  // of the points as they were given
  std::optional<double> constant;    // C
  std::optional<double> order;       // p
  std::optional<double> walk;        // B
  std::optional<double> drift;       // D
  // Root mean square of log10(error) against the fit, over the points that belong to it; nothing where none
  // does.
  std::optional<double> residual;
  // A residual above 0.3, a factor of two, or more points of errors below 0.1 left out than fitted: the error
  // is not of this form, which is a finding.
  bool bad = false;
  // Of the points the one with the least error, and where the branches cross; nothing where rounding was not
  // reached.
  std::optional<double> best_dt;
  std::optional<double> best_error;
  std::optional<double> crossing_dt;
};

// `roundoff` is u.  Points in any order, of positive dt and steps.  Fewer than three that belong to a curve
// are left out, as are errors of 0.1 and more; and what falls where steps are added is no rounding.
[[nodiscard]] ErrorFit fit_error(const std::vector<FitPoint>& points, double roundoff);

// The fit's value: max of the branches that it has; NaN of none.
[[nodiscard]] double fitted_error(const ErrorFit& fit, double dt, double steps, double roundoff);

}  // namespace ulpgate
