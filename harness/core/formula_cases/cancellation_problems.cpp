// Functions near the argument at which their textbook form cancels.
#include "harness/core/formula_cases/formula_problem.hpp"

namespace ulpgate {

namespace {

// The naive forms in 2326 bits, of which they lose 1000 at most.
FormulaNumbers one_minus_cosine_truth(const FormulaInput& in) {
  const FormulaNumber& x = in.x[0];
  return {FormulaNumber((1 - cos(x)) / (x * x))};
}
FormulaNumbers exponential_quotient_truth(const FormulaInput& in) {
  return {FormulaNumber((exp(in.x[0]) - 1) / in.x[0])};
}
FormulaNumbers log_of_one_plus_truth(const FormulaInput& in) {
  return {FormulaNumber(log(FormulaNumber(1 + in.x[0])))};
}

FormulaNumbers alone(const FormulaNumber& x) {
  return {x};
}

std::vector<KnownVerdict> cancels(const std::string& what) {
  return {{"all", StressVerdict::unstable, "of the method: " + what}};
}

}  // namespace

std::vector<FormulaProblem> cancellation_problems() {
  return {
      {.name = "one_minus_cosine",
       .title = "(1 - cos x)/x^2 at 1.2e-8 rounded to the type, 1/2; 0.77 in double",
       .at = "x = 1.2e-8",
       .input = stated({"1.2e-8"}),
       .truth = one_minus_cosine_truth,
       .forms = {{"naive", cancels("1 - cos x keeps the digits of cos x behind the 16th alone")},
                 {"half_angle"}},
       .scan = scan_binades("x", 0, -40, alone)},
      {.name = "one_minus_cosine_at_sqrt_u",
       .title = "(1 - cos x)/x^2 at the root of the unit roundoff",
       .at = "x = sqrt u",
       .input =
           [](const FloatFormat& f) {
             return FormulaInput{{power_of_two(-(f.precision + 1) / 2)}, 0};
           },
       .truth = one_minus_cosine_truth,
       .forms = {{"naive", cancels("cos x is 1 within one rounding")}, {"half_angle"}}},
      {.name = "exponential_quotient",
       .title = "(e^x - 1)/x at 1e-15 rounded to the type, 1; 1.11 in double",
       .at = "x = 1e-15",
       .input = stated({"1e-15"}),
       .truth = exponential_quotient_truth,
       .forms = {{"naive", cancels("e^x - 1 keeps the digits of e^x behind the 15th alone")},
                 {"kahan"},
                 {"expm1"}},
       .scan = scan_binades("x", 0, -60, alone)},
      {.name = "log_of_one_plus",
       .title = "log(1 + x) at 1e-17 rounded to the type; 0 in double",
       .at = "x = 1e-17",
       .input = stated({"1e-17"}),
       .truth = log_of_one_plus_truth,
       .forms = {{"naive", cancels("1 + x rounds away the digits of x")}, {"kahan"}, {"log1p"}},
       // 1 + x is exact where x is a power of two
       .scan = scan_binades("3x", 0, -60, [](const FormulaNumber& x) { return alone(x / 3); })},
  };
}

}  // namespace ulpgate
