// Areas, angles, orientations, and complex division.
#include "harness/core/formula_cases/formula_problem.hpp"

namespace ulpgate {

namespace {

// 16 A^2 = 2 a^2 b^2 + 2 b^2 c^2 + 2 c^2 a^2 - a^4 - b^4 - c^4.
FormulaNumbers area_truth(const FormulaInput& in) {
  const FormulaNumber a(in.x[0] * in.x[0]);
  const FormulaNumber b(in.x[1] * in.x[1]);
  const FormulaNumber c(in.x[2] * in.x[2]);
  const FormulaNumber squared(2 * (a * b + b * c + c * a) - a * a - b * b - c * c);
  return {FormulaNumber(sqrt(squared) / 4)};
}

// 2 atan2(| u |v| - v |u| |, | u |v| + v |u| |) (W. Kahan, How futile are mindless assessments of roundoff,
// 2006).
FormulaNumbers angle_truth(const FormulaInput& in) {
  FormulaNumber u2(0);
  FormulaNumber v2(0);
  for (std::size_t i = 0; i < 3; ++i) {
    u2 += in.x[i] * in.x[i];
    v2 += in.x[i + 3] * in.x[i + 3];
  }
  const FormulaNumber u(sqrt(u2));
  const FormulaNumber v(sqrt(v2));
  FormulaNumber minus(0);
  FormulaNumber plus(0);
  for (std::size_t i = 0; i < 3; ++i) {
    const FormulaNumber difference(in.x[i] * v - in.x[i + 3] * u);
    const FormulaNumber sum(in.x[i] * v + in.x[i + 3] * u);
    minus += difference * difference;
    plus += sum * sum;
  }
  return {FormulaNumber(2 * atan2(FormulaNumber(sqrt(minus)), FormulaNumber(sqrt(plus))))};
}

FormulaNumbers angle_arguments(const FormulaNumber& x) {
  return {FormulaNumber(1), FormulaNumber(0), FormulaNumber(0), FormulaNumber(1), x, FormulaNumber(0)};
}

// The determinant of (p, (12, 12), (24, 24)) is 12 (p_y - p_x).
FormulaNumbers orientation_truth(const FormulaInput& in) {
  FormulaNumbers signs;
  for (long i = 0; i < in.n; ++i) {
    for (long j = 0; j < in.n; ++j) signs.emplace_back(j > i ? 1 : (j < i ? -1 : 0));
  }
  return signs;
}

FormulaNumbers quotient_truth(const FormulaInput& in) {
  const FormulaNumber divisor(in.x[2] * in.x[2] + in.x[3] * in.x[3]);
  return {FormulaNumber((in.x[0] * in.x[2] + in.x[1] * in.x[3]) / divisor),
          FormulaNumber((in.x[1] * in.x[2] - in.x[0] * in.x[3]) / divisor)};
}

}  // namespace

std::vector<FormulaProblem> geometry_problems() {
  return {
      {.name = "triangle_area",
       .title = "area of Kahan's triangle with sides 1e5, 99999.99979, 2.9e-4 rounded to the type",
       .at = "a = 1e5, b = 99999.99979, c = 2.9e-4",
       .input = stated({"1e5", "99999.99979", "2.9e-4"}),
       .truth = area_truth,
       .forms = {{"heron",
                  {{"float", StressVerdict::unstable,
                    "of the method: in float the sides are those of a needle with two equal ones, which is "
                    "well-conditioned"}}},
                 {"kahan"}}},
      {.name = "needle_area",
       .title = "area of the needle with sides 1e5, 1e5, 2.9e-4, which is well-conditioned",
       .at = "a = b = 1e5, c = 2.9e-4",
       .input = stated({"1e5", "1e5", "2.9e-4"}),
       .truth = area_truth,
       .forms = {{"heron",
                  {{"all", StressVerdict::unstable,
                    "of the method: the half sum is rounded before the long sides are taken from it"}}},
                 {"kahan"}},
       .scan = scan_binades("3c/a", 0, -40,
                            [](const FormulaNumber& c) {
                              return FormulaNumbers{FormulaNumber(1), FormulaNumber(1), FormulaNumber(c / 3)};
                            })},
      {.name = "small_angle",
       .title = "angle between (1, 0, 0) and (1, 1e-8, 0); 0 in double by the arc cosine",
       .at = "angle 1e-8",
       .input =
           [](const FloatFormat&) {
             return FormulaInput{angle_arguments(number("1e-8")), 0};
           },
       .truth = angle_truth,
       .forms = {{"arc_cosine",
                  {{"all", StressVerdict::unstable, "of the method: the cosine of a small angle is flat"}}},
                 {"arc_tangent"}},
       .scan = scan_binades("angle", 0, -40, angle_arguments)},
      {.name = "orient2d",
       .title = "side of 32 x 32 points one ulp apart near the line through (12, 12) and (24, 24)",
       .at = "points from (1/2, 1/2) on",
       .input =
           [](const FloatFormat& f) {
             return FormulaInput{{power_of_two(-f.precision)}, 32};
           },
       .truth = orientation_truth,
       .forms = {{"naive",
                  {{"all", StressVerdict::wrong_outcome,
                    "of the method: rounded differences and products have another sign than exact ones"}}},
                 {"exact"}},
       .norm = FormulaNorm::signs,
       .cost = 0.02},
  };
}

std::vector<FormulaProblem> complex_problems() {
  return {
      {.name = "complex_quotient",
       .title = "(1 + 2i)/(3 + 4i)",
       .at = "(1 + 2i)/(3 + 4i)",
       .input = stated({"1", "2", "3", "4"}),
       .truth = quotient_truth,
       .forms = {{"naive"}, {"smith"}, {"robust"}}},
      {.name = "complex_quotient_near_overflow",
       .title = "(2 + i)/(1 + 2i) times max/4 above and below",
       .at = "max/4 (2 + i) / (max/4 (1 + 2i))",
       .input =
           [](const FloatFormat& f) {
             const FormulaNumber q(largest_of(f) / 4);
             return FormulaInput{{FormulaNumber(2 * q), q, q, FormulaNumber(2 * q)}, 0};
           },
       .truth = quotient_truth,
       .forms = {{"naive",
                  {{"all", StressVerdict::diverged, "of the method: squares of the divisor overflow"}}},
                 {"smith"},
                 {"robust"}}},
      {.name = "complex_quotient_uneven",
       .title = "(2^3k + 2^-3k i)/(2^2k + 2^-2k i) at the ends of the range (Baudin and Smith 2012)",
       .at = "k a third of the largest exponent",
       .input =
           [](const FloatFormat& f) {
             const long k = (f.exponent_max - 1) / 3;
             return FormulaInput{
                 {power_of_two(3 * k), power_of_two(-3 * k), power_of_two(2 * k), power_of_two(-2 * k)}, 0};
           },
       .truth = quotient_truth,
       .forms = {{"naive",
                  {{"all", StressVerdict::diverged, "of the method: squares of the divisor overflow"}}},
                 {"smith",
                  {{"all", StressVerdict::unstable,
                    "of the method: the ratio of the divisor's parts underflows, and the imaginary part with "
                    "it"}}},
                 {"robust"}},
       .norm = FormulaNorm::each},
  };
}

}  // namespace ulpgate
