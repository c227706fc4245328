// Arguments at the ends of every type's range.
#include "harness/core/formula_cases/formula_problem.hpp"

namespace ulpgate {

namespace {

FormulaNumbers norm_truth(const FormulaInput& in) {
  FormulaNumber squares(0);
  for (const auto& x : in.x) squares += x * x;
  return {FormulaNumber(sqrt(squares))};
}

FormulaNumbers mean_truth(const FormulaInput& in) {
  return {FormulaNumber(sum_truth(in).front() / static_cast<long>(in.x.size()))};
}

using End = FormulaNumber (*)(const FloatFormat&);

// Quarters of an end of the range as arguments.
std::function<FormulaInput(const FloatFormat&)> quarters(End end, std::vector<int> x) {
  return [end, x = std::move(x)](const FloatFormat& f) {
    FormulaInput input;
    for (const int q : x) input.x.emplace_back(end(f) * q / 4);
    return input;
  };
}

std::vector<FormulaForm> forms(const std::string& types, StressVerdict verdict, const std::string& cause,
                               const std::string& twin) {
  return {{"naive", {{types, verdict, cause}}}, {twin}};
}

constexpr const char* overflowing_squares = "of the method: squares overflow, the root of their sum does not";
constexpr const char* vanishing_squares = "of the method: squares underflow, the root of their sum does not";

// A function of the type's own library at one end of the range.
FormulaProblem library(const std::string& name, const std::string& title, const std::string& at,
                       std::function<FormulaNumber(const FloatFormat&)> x,
                       FormulaNumber (*f)(const FormulaNumber&)) {
  return {.name = name,
          .title = title,
          .at = at,
          .input =
              [x = std::move(x)](const FloatFormat& format) {
                return FormulaInput{{x(format)}, 0};
              },
          .truth = [f](const FormulaInput& in) { return FormulaNumbers{f(in.x[0])}; },
          .forms = {{"library"}}};
}

// One roundoff and a half nearer to 0, so that rounding to the type does not lead out of its range.
FormulaNumber inwards(const FormulaNumber& x, const FloatFormat& f) {
  return x * (1 - 3 * power_of_two(-f.precision));
}

FormulaNumber sqrt_of(const FormulaNumber& x) {
  return sqrt(x);
}
FormulaNumber exp_of(const FormulaNumber& x) {
  return exp(x);
}
FormulaNumber log_of(const FormulaNumber& x) {
  return log(x);
}
FormulaNumber log1p_of(const FormulaNumber& x) {
  return log1p(x);
}
FormulaNumber expm1_of(const FormulaNumber& x) {
  return expm1(x);
}

}  // namespace

std::vector<FormulaProblem> range_problems() {
  const auto diverged = StressVerdict::diverged;
  const auto unstable = StressVerdict::unstable;
  return {
      {.name = "hypot_1e200",
       .title = "sqrt(x^2 + y^2) at 1e200, 1e200; infinite in double",
       .at = "x = y = 1e200",
       .input = stated({"1e200", "1e200"}),
       .truth = norm_truth,
       .forms = forms("double", diverged, "of the type's range: 1e400 is no number of it", "hypot")},
      {.name = "hypot_half_max",
       .title = "sqrt(x^2 + y^2) at half of the largest number",
       .at = "x = y = max/2",
       .input = quarters(largest_of, {2, 2}),
       .truth = norm_truth,
       .forms = forms("all", diverged, overflowing_squares, "hypot")},
      {.name = "hypot_max_and_0",
       .title = "sqrt(x^2 + y^2) at the largest number and 0",
       .at = "x = max, y = 0",
       .input = quarters(largest_of, {4, 0}),
       .truth = norm_truth,
       .forms = forms("all", diverged, overflowing_squares, "hypot")},
      {.name = "hypot_least_normal",
       .title = "sqrt(x^2 + y^2) at 3 and 4 times the least normal number",
       .at = "x = 3 min, y = 4 min",
       .input = quarters(least_normal_of, {12, 16}),
       .truth = norm_truth,
       .forms = forms("all", unstable, vanishing_squares, "hypot")},
      {.name = "hypot_least",
       .title = "sqrt(x^2 + y^2) at 3 and 4 times the least positive number",
       .at = "x = 3 least, y = 4 least",
       .input = quarters(least_of, {12, 16}),
       .truth = norm_truth,
       .forms = forms("all", unstable, vanishing_squares, "hypot")},
      {.name = "norm_near_overflow",
       .title = "length of a vector of four quarters of the largest number",
       .at = "x_i = max/4",
       .input = quarters(largest_of, {1, 1, 1, 1}),
       .truth = norm_truth,
       .forms = forms("all", diverged, overflowing_squares, "scaled")},
      {.name = "norm_near_underflow",
       .title = "length of (3, 4, 12) times the least normal number",
       .at = "x = (3, 4, 12) min",
       .input = quarters(least_normal_of, {12, 16, 48}),
       .truth = norm_truth,
       .forms = forms("all", unstable, vanishing_squares, "scaled")},
      {.name = "midpoint_at_max",
       .title = "mean of the largest number and its half",
       .at = "a = max, b = max/2",
       .input = quarters(largest_of, {4, 2}),
       .truth = mean_truth,
       .forms = forms("all", diverged, "of the method: the sum overflows before it is halved", "halves")},
      {.name = "sum_near_overflow",
       .title = "3/4 + 3/4 - 1 times the largest number",
       .at = "x = 3/4 max, 3/4 max, -max",
       .input = quarters(largest_of, {3, 3, -4}),
       .truth = sum_truth,
       .forms = forms("all", diverged, "of the method: a partial sum overflows, the sum does not", "scaled")},
      library("sqrt_least", "square root of the least positive number", "x = least", least_of, sqrt_of),
      library("sqrt_max", "square root of the largest number", "x = max", largest_of, sqrt_of),
      library(
          "exp_below_overflow", "exponential one step below overflow", "x = log max",
          [](const FloatFormat& f) { return inwards(log(largest_of(f)), f); }, exp_of),
      library(
          "exp_above_underflow", "exponential one step above the least normal number", "x = log min",
          [](const FloatFormat& f) { return inwards(log(least_normal_of(f)), f); }, exp_of),
      library("log_least", "logarithm of the least positive number", "x = least", least_of, log_of),
      library("log_max", "logarithm of the largest number", "x = max", largest_of, log_of),
      library("log1p_least_normal", "log1p of the least normal number", "x = min", least_normal_of, log1p_of),
      library("expm1_least_normal", "expm1 of the least normal number", "x = min", least_normal_of, expm1_of),
  };
}

}  // namespace ulpgate
