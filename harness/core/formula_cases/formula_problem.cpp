// formula_problems(): the problems of all themes, and what their rows are made with.
#include "harness/core/formula_cases/formula_problem.hpp"

#include "reference/text/literal.hpp"

namespace ulpgate {

const std::vector<FormulaProblem>& formula_problems() {
  static const std::vector<FormulaProblem> problems = [] {
    std::vector<FormulaProblem> all;
    for (auto list : {polynomial_problems(), recurrence_problems(), sum_problems(), cancellation_problems(),
                      geometry_problems(), complex_problems(), range_problems()}) {
      for (auto& p : list) all.push_back(std::move(p));
    }
    return all;
  }();
  return problems;
}

bool exists_in(const FormulaProblem& problem, std::string_view token) {
  if (problem.types == "all") return true;
  return ("," + problem.types + ",").find("," + std::string(token) + ",") != std::string::npos;
}

FormulaNumber number(const std::string& text) {
  return real<FormulaNumber>(text);
}

std::function<FormulaInput(const FloatFormat&)> stated(std::vector<std::string> x, long n) {
  return [x = std::move(x), n](const FloatFormat&) {
    FormulaInput input{{}, n};
    for (const auto& text : x) input.x.push_back(number(text));
    return input;
  };
}

FormulaNumbers sum_truth(const FormulaInput& in) {
  FormulaNumber sum(0);
  for (const auto& x : in.x) sum += x;
  return {sum};
}

FormulaNumber power_of_two(long exponent) {
  FormulaNumber result;
  mpfr_set_ui_2exp(result.backend().data(), 1, exponent, MPFR_RNDN);
  return result;
}

FormulaNumber largest_of(const FloatFormat& format) {
  return (2 - power_of_two(1 - format.precision)) * power_of_two(format.exponent_max);
}
FormulaNumber least_normal_of(const FloatFormat& format) {
  return power_of_two(format.exponent_min);
}
FormulaNumber least_of(const FloatFormat& format) {
  return power_of_two(format.exponent_least());
}

std::function<std::vector<FormulaScanPoint>(const FloatFormat&)> scan_binades(
    std::string variable, int first, int last, std::function<FormulaNumbers(const FormulaNumber&)> make) {
  return [variable = std::move(variable), first, last, make = std::move(make)](const FloatFormat&) {
    std::vector<FormulaScanPoint> points;
    const int step = first < last ? 1 : -1;
    for (int e = first; e != last + step; e += step)
      points.push_back({variable + " = 2^" + std::to_string(e), {make(power_of_two(e)), 0}});
    return points;
  };
}

std::function<std::vector<FormulaScanPoint>(const FloatFormat&)> scan_steps(std::vector<std::string> x,
                                                                            long first, long last) {
  return [x = std::move(x), first, last](const FloatFormat& format) {
    std::vector<FormulaScanPoint> points;
    for (long n = first; n <= last; ++n) points.push_back({"n = " + std::to_string(n), stated(x, n)(format)});
    return points;
  };
}

}  // namespace ulpgate
