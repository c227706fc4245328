// Recurrences; their condition is that of the map from the start to the last term.
#include "harness/core/formula_cases/formula_problem.hpp"

namespace ulpgate {

namespace {

// u_n = y_{n+1} / y_n with y_{k+3} = 111 y_{k+2} - 1130 y_{k+1} + 3000 y_k, which is linear and of integers.
FormulaNumbers muller_truth(const FormulaInput& in) {
  FormulaNumber y0(1);
  FormulaNumber y1(in.x[0]);
  FormulaNumber y2(in.x[0] * in.x[1]);
  for (long k = 1; k < in.n; ++k) {
    const FormulaNumber y3(111 * y2 - 1130 * y1 + 3000 * y0);
    y0 = y1;
    y1 = y2;
    y2 = y3;
  }
  return {FormulaNumber(y2 / y1)};
}

// n! (x - 1/1! - ... - 1/n!).
FormulaNumbers account_truth(const FormulaInput& in) {
  FormulaNumber term(1);
  FormulaNumber sum(0);
  for (long k = 1; k <= in.n; ++k) {
    term /= k;
    sum += term;
  }
  return {FormulaNumber((in.x[0] - sum) / term)};
}

FormulaInput account_input(long n) {
  return {{FormulaNumber(exp(FormulaNumber(1)) - 1)}, n};
}

FormulaNumbers logistic_truth(const FormulaInput& in) {
  const FormulaNumber angle(asin(FormulaNumber(sqrt(in.x[0]))) * power_of_two(in.n));
  const FormulaNumber s(sin(angle));
  return {FormulaNumber(s * s)};
}

}  // namespace

std::vector<FormulaProblem> recurrence_problems() {
  return {
      {.name = "muller",
       .title = "Muller's u_30 from 2, -4, near 6; 100 in double",
       .at = "n = 30",
       .input = stated({"2", "-4"}, 30),
       .truth = muller_truth,
       .forms = {{"recurrence"}, {"closed_form"}},
       .scan = scan_steps({"2", "-4"}, 2, 30)},
      {.name = "bank_account",
       .title = "a_25 of a_n = n a_{n-1} - 1 from e - 1 (the exact e), 0.0399; condition 25!",
       .at = "n = 25",
       .input = [](const FloatFormat&) { return account_input(25); },
       .truth = account_truth,
       .forms = {{"forward"}, {"backward"}},
       .meant = Meant::as_stated,
       .scan =
           [](const FloatFormat&) {
             std::vector<FormulaScanPoint> points;
             for (long n = 1; n <= 25; ++n) points.push_back({"n = " + std::to_string(n), account_input(n)});
             return points;
           }},
      {.name = "logistic_map",
       .title = "60 steps of x <- 4 x (1 - x) from 1/8: chaos, one bit a step",
       .at = "n = 60",
       .input = stated({"0.125"}, 60),
       .truth = logistic_truth,
       .forms = {{"recurrence"}, {"closed_form"}},
       .scan = scan_steps({"0.125"}, 1, 60)},
      {.name = "roots_then_squares",
       .title = "60 square roots of 100, then 60 squares, 100; 1 in double (Kahan)",
       .at = "n = 60",
       .input = stated({"100"}, 60),
       .truth = [](const FormulaInput& in) { return in.x; },
       .forms = {{"naive",
                  {{"all", StressVerdict::unstable,
                    "of the method: a root so near to 1 costs 58 of the bits there are"}}},
                 {"logarithm",
                  {{"cpp_bin_float62", StressVerdict::unstable,
                    "of the type's library: Boost 1.81's log of cpp_bin_float is off by 6 ULP at 100, and "
                    "the exponential "
                    "multiplies that by log 100"}}},
                 {"parts"}},
       .scan = scan_steps({"100"}, 1, 60)},
  };
}

}  // namespace ulpgate
