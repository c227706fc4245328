// fit_error().
#include "harness/core/work_precision/error_fit.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

namespace ulpgate {

namespace {

constexpr double none = -std::numeric_limits<double>::infinity();

// Scatter of log10(error) that is expected of each branch: time-stepping is smooth, rounding is a draw.
constexpr double stepping_scatter = 0.05;
constexpr double rounding_scatter = 0.3;
// What a parameter and a point left out cost, in units of squares of the scatter.
constexpr double parameter_price = 3;
constexpr double left_out_price = 9;
// A relative error of this size or above says nothing of an order.
constexpr double unresolved_error = 0.1;
constexpr double least_order = 0.5;
constexpr double bad_residual = 0.3;
// Fewer points are no curve.
constexpr std::size_t least_fitted = 3;

// A point of the curve in logarithms to base 10.
struct LogPoint {
  double dt;
  double steps;
  double error;
};

struct Model {
  double log_c = none;
  double order = 0;
  double log_b = none;
  double log_d = none;

  [[nodiscard]] std::array<double, 3> branches(const LogPoint& p, double log_u) const {
    return {log_c + order * p.dt, log_b + p.steps / 2 + log_u, log_d + p.steps + log_u};
  }
};

// How the points, coarsest first, are dealt: [0, left_out), [left_out, walk), [walk, drift), [drift, all).
struct Cut {
  std::size_t left_out;
  std::size_t walk;
  std::size_t drift;
};

bool fit_stepping(const std::vector<LogPoint>& points, const Cut& cut, Model& model) {
  const std::size_t count = cut.walk - cut.left_out;
  if (count == 0) return true;
  if (count < 2) return false;
  double x = 0;
  double y = 0;
  for (std::size_t i = cut.left_out; i < cut.walk; ++i) {
    x += points[i].dt / static_cast<double>(count);
    y += points[i].error / static_cast<double>(count);
  }
  double xx = 0;
  double xy = 0;
  for (std::size_t i = cut.left_out; i < cut.walk; ++i) {
    xx += (points[i].dt - x) * (points[i].dt - x);
    xy += (points[i].dt - x) * (points[i].error - y);
  }
  if (!(xx > 0)) return false;
  model.order = xy / xx;
  model.log_c = y - model.order * x;
  return model.order >= least_order;
}

// Rounding does not shrink where steps are added: over at least this part, for what of it is a draw.
constexpr double least_rounding_slope = -0.25;  // of log10(error) over log10(n)
constexpr double least_ratio = -0.15;           // log10, of one point to the one before

bool does_not_fall(const std::vector<LogPoint>& points, std::size_t first, std::size_t last) {
  if (first == last) return true;
  if (last - first == 1) return first > 0 && points[first].error - points[first - 1].error >= least_ratio;
  double x = 0;
  double y = 0;
  double xx = 0;
  double xy = 0;
  for (std::size_t i = first; i < last; ++i) {
    x += points[i].steps;
    y += points[i].error;
    xx += points[i].steps * points[i].steps;
    xy += points[i].steps * points[i].error;
  }
  const auto n = static_cast<double>(last - first);
  return (n * xy - x * y) >= least_rounding_slope * (n * xx - x * x);
}

// The mean of log10(error) - exponent log10(n) - log10(u).
double fit_rounding(const std::vector<LogPoint>& points, std::size_t first, std::size_t last, double exponent,
                    double log_u) {
  if (first == last) return none;
  double sum = 0;
  for (std::size_t i = first; i < last; ++i) sum += points[i].error - exponent * points[i].steps - log_u;
  return sum / static_cast<double>(last - first);
}

struct Scored {
  double score = std::numeric_limits<double>::infinity();
  Cut cut{};
  Model model;
};

double score_of(const std::vector<LogPoint>& points, const Cut& cut, const Model& model, double log_u) {
  const double n = static_cast<double>(points.size());
  double parameters = cut.walk > cut.left_out ? 2 : 0;
  parameters += cut.drift > cut.walk ? 1 : 0;
  parameters += points.size() > cut.drift ? 1 : 0;
  double score = parameters * parameter_price * std::max(1.0, std::log(n) / 2);
  score += static_cast<double>(cut.left_out) * left_out_price;
  for (std::size_t i = cut.left_out; i < points.size(); ++i) {
    const auto branches = model.branches(points[i], log_u);
    const double off = points[i].error - *std::ranges::max_element(branches);
    const double scatter = i < cut.walk ? stepping_scatter : rounding_scatter;
    score += off * off / (scatter * scatter);
  }
  return score;
}

Scored best_cut(const std::vector<LogPoint>& points, std::size_t coarse, double log_u) {
  Scored best;
  const std::size_t n = points.size();
  for (std::size_t left_out = coarse; left_out <= n; ++left_out) {
    for (std::size_t walk = left_out; walk <= n; ++walk) {
      Model model;
      if (left_out < n && n - left_out < least_fitted) continue;
      if (!fit_stepping(points, {left_out, walk, n}, model)) continue;
      if (!does_not_fall(points, walk, n)) continue;
      for (std::size_t drift = walk; drift <= n; ++drift) {
        const Cut cut{left_out, walk, drift};
        model.log_b = fit_rounding(points, walk, drift, 0.5, log_u);
        model.log_d = fit_rounding(points, drift, n, 1, log_u);
        const double score = score_of(points, cut, model, log_u);
        if (score < best.score) best = {score, cut, model};
      }
    }
  }
  return best;
}

std::optional<double> crossing(const ErrorFit& fit, double time, double roundoff) {
  if (!fit.order) return std::nullopt;
  std::optional<double> dt;
  const double p = *fit.order;
  const auto meet = [&](double rounding, double exponent) {
    const double at = std::pow(rounding / *fit.constant, 1 / (p + exponent));
    dt = std::max(dt.value_or(0), at);
  };
  if (fit.walk) meet(*fit.walk * roundoff * std::sqrt(time), 0.5);
  if (fit.drift) meet(*fit.drift * roundoff * time, 1);
  return dt;
}

void judge(const std::vector<LogPoint>& points, std::size_t coarse, const Scored& best, double log_u,
           ErrorFit& fit) {
  double squares = 0;
  std::size_t fitted = 0;
  for (std::size_t i = best.cut.left_out; i < points.size(); ++i, ++fitted) {
    const auto branches = best.model.branches(points[i], log_u);
    const double off = points[i].error - *std::ranges::max_element(branches);
    squares += off * off;
  }
  if (fitted == 0) {
    // Points enough for a fit, and none of them in one.
    fit.bad = points.size() >= coarse + least_fitted;
    return;
  }
  fit.residual = std::sqrt(squares / static_cast<double>(fitted));
  fit.bad = *fit.residual > bad_residual || best.cut.left_out - coarse > fitted;
}

}  // namespace

std::string_view to_string(ErrorRegime regime) {
  constexpr std::array<std::string_view, 6> names = {"failed",        "exact",       "unresolved",
                                                     "time-stepping", "random walk", "linear drift"};
  return names.at(static_cast<std::size_t>(regime));
}

ErrorFit fit_error(const std::vector<FitPoint>& points, double roundoff) {
  ErrorFit fit;
  fit.regimes.assign(points.size(), ErrorRegime::failed);
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!std::isfinite(points[i].error)) continue;
    if (points[i].error == 0) fit.regimes[i] = ErrorRegime::exact;
    if (!fit.best_error || points[i].error < *fit.best_error) {
      fit.best_error = points[i].error;
      fit.best_dt = points[i].dt;
    }
    if (points[i].error > 0) order.push_back(i);
  }
  std::ranges::stable_sort(order, std::ranges::greater{}, [&](std::size_t i) { return points[i].dt; });
  std::vector<LogPoint> logs;
  for (const auto i : order)
    logs.push_back({std::log10(points[i].dt), std::log10(points[i].steps), std::log10(points[i].error)});
  // What is coarse is left out for nothing.
  std::size_t coarse = 0;
  while (coarse < order.size() && points[order[coarse]].error >= unresolved_error) ++coarse;
  if (order.empty()) return fit;
  const double log_u = std::log10(roundoff);
  const Scored best = best_cut(logs, coarse, log_u);
  for (std::size_t i = 0; i < order.size(); ++i) {
    ErrorRegime regime = ErrorRegime::linear_drift;
    if (i < best.cut.left_out) {
      regime = ErrorRegime::unresolved;
    } else if (i < best.cut.drift) {
      regime = i < best.cut.walk ? ErrorRegime::stepping : ErrorRegime::random_walk;
    }
    fit.regimes[order[i]] = regime;
  }
  if (best.cut.walk > best.cut.left_out) {
    fit.order = best.model.order;
    fit.constant = std::pow(10, best.model.log_c);
  }
  if (best.cut.drift > best.cut.walk) fit.walk = std::pow(10, best.model.log_b);
  if (logs.size() > best.cut.drift) fit.drift = std::pow(10, best.model.log_d);
  judge(logs, coarse, best, log_u, fit);
  const auto& some = points[order.front()];
  fit.crossing_dt = crossing(fit, some.dt * some.steps, roundoff);
  return fit;
}

double fitted_error(const ErrorFit& fit, double dt, double steps, double roundoff) {
  double error = std::numeric_limits<double>::quiet_NaN();
  const auto raise = [&](double branch) { error = std::isnan(error) ? branch : std::max(error, branch); };
  if (fit.order) raise(*fit.constant * std::pow(dt, *fit.order));
  if (fit.walk) raise(*fit.walk * std::sqrt(steps) * roundoff);
  if (fit.drift) raise(*fit.drift * steps * roundoff);
  return error;
}

}  // namespace ulpgate
