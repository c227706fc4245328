// Rump's polynomials, Kahan's Monster, roots of polynomials.
#include "harness/core/formula_cases/formula_problem.hpp"

namespace ulpgate {

namespace {

// The polynomial in 2326 bits: of integers of 17 bits all of it is exact, but for the last quotient.
FormulaNumbers rump_1988_truth(const FormulaInput& in) {
  const FormulaNumber& a = in.x[0];
  const FormulaNumber& b = in.x[1];
  const FormulaNumber a2(a * a);
  const FormulaNumber b2(b * b);
  const FormulaNumber b4(b2 * b2);
  const FormulaNumber polynomial(b4 * b2 * 1335 / 4 + 11 * a2 * a2 * b2 - a2 * b4 * b2 - 121 * a2 * b4 -
                                 2 * a2 + b4 * b4 * 11 / 2);
  return {FormulaNumber(polynomial + a / (2 * b))};
}

FormulaNumbers rump_1983_truth(const FormulaInput& in) {
  const FormulaNumber x2(in.x[0] * in.x[0]);
  const FormulaNumber y2(in.x[1] * in.x[1]);
  return {FormulaNumber(9 * x2 * x2 - y2 * y2 + 2 * y2)};
}

FormulaNumbers small_root_truth(const FormulaInput& in) {
  const FormulaNumber discriminant(in.x[1] * in.x[1] - 4 * in.x[0] * in.x[2]);
  return {FormulaNumber((-in.x[1] - sqrt(discriminant)) / (2 * in.x[0]))};
}

// Coefficients of (x - 1) ... (x - degree), the highest power first.
FormulaInput wilkinson(const FloatFormat&) {
  constexpr long degree = 20;
  FormulaNumbers c{FormulaNumber(1)};
  for (long k = 1; k <= degree; ++k) {
    c.emplace_back(0);
    for (std::size_t i = c.size() - 1; i > 0; --i) c[i] -= k * c[i - 1];
  }
  return {c, degree};
}

// The root that stands at 14 of the exact coefficients: steps of Newton's iteration from there, each of which
// squares the distance.
FormulaNumbers root_14_truth(const FormulaInput& in) {
  FormulaNumber x(14);
  for (int i = 0; i < 3; ++i) {
    FormulaNumber value(in.x[0]);
    FormulaNumber slope(0);
    for (std::size_t k = 1; k < in.x.size(); ++k) {
      slope = slope * x + value;
      value = value * x + in.x[k];
    }
    x -= value / slope;
  }
  return {x};
}

}  // namespace

std::vector<FormulaProblem> polynomial_problems() {
  return {
      {.name = "rump_1988",
       .title = "Rump's polynomial of 1988, -54767/66192; -1.18e21 and 1.1726 in double",
       .at = "a = 77617, b = 33096",
       .input = stated({"77617", "33096"}),
       .truth = rump_1988_truth,
       .forms = {{"original_order"}, {"reordered"}}},
      {.name = "rump_1983",
       .title = "9 x^4 - y^4 + 2 y^2 of Rump 1983, 1; 2 in double",
       .at = "x = 10864, y = 18817",
       .input = stated({"10864", "18817"}),
       .truth = rump_1983_truth,
       .forms = {{"expanded"}, {"factored"}}},
      {.name = "kahans_monster",
       .title = "Kahan's Monster, 1; 0 in every precision",
       .at = "x = 15, 16, 17, 9999",
       .input = stated({"15", "16", "17", "9999"}),
       .truth = [](const FormulaInput& in) { return FormulaNumbers(in.x.size(), FormulaNumber(1)); },
       .forms =
           {{"naive",
             {{"all", StressVerdict::unstable,
               "of the method: e^z - 1 of squared rounding noise z is 0 in every precision, and z is not"}}},
            {"expm1"}}},
      {.name = "quadratic_small_root",
       .title = "the small root of x^2 - 1e8 x + 1; 7.45e-9 in double",
       .at = "b = -1e8",
       .input = stated({"1", "-1e8", "1"}),
       .truth = small_root_truth,
       .forms = {{"naive",
                  {{"all", StressVerdict::unstable,
                    "of the method: -b and the root of the discriminant agree in 16 digits and cancel"}}},
                 {"stable"}},
       .scan = scan_binades("-b", 2, 40,
                            [](const FormulaNumber& x) {
                              return FormulaNumbers{FormulaNumber(1), FormulaNumber(-x), FormulaNumber(1)};
                            })},
      {.name = "wilkinson_root_14",
       .title = "root 14 of Wilkinson's polynomial of degree 20; condition 5.4e13 in its coefficients",
       .at = "degree 20, Newton from 14.25",
       .input = wilkinson,
       .truth = root_14_truth,
       .forms = {{"coefficients"}, {"product"}},
       .meant = Meant::as_stated},
  };
}

}  // namespace ulpgate
