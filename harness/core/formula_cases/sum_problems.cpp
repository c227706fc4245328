// Sums, variances, sums of exponentials.
#include "harness/core/formula_cases/formula_problem.hpp"

namespace ulpgate {

namespace {

// H_n = psi(n + 1) + gamma.
FormulaNumbers harmonic_truth(const FormulaInput& in) {
  FormulaNumber psi(in.n + 1);
  mpfr_digamma(psi.backend().data(), psi.backend().data(), MPFR_RNDN);
  FormulaNumber gamma;
  mpfr_const_euler(gamma.backend().data(), MPFR_RNDN);
  return {FormulaNumber(psi + gamma)};
}

// Squares of the differences of all pairs over n (n - 1): no mean is formed.
FormulaNumbers variance_truth(const FormulaInput& in) {
  const auto n = static_cast<long>(in.x.size());
  FormulaNumber sum(0);
  for (std::size_t i = 0; i < in.x.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const FormulaNumber d(in.x[i] - in.x[j]);
      sum += d * d;
    }
  }
  return {FormulaNumber(sum / (n * (n - 1)))};
}

FormulaNumbers around(const FormulaNumber& mean) {
  FormulaNumbers x;
  for (const int d : {4, 7, 13, 16}) x.emplace_back(mean + d);
  return x;
}

// Means of 1, 3, 5 ... bits 0101...01 up to the type's last.
std::vector<FormulaScanPoint> scan_means(const FloatFormat& format) {
  std::vector<FormulaScanPoint> points;
  for (long k = 4; k < format.precision; k += 2) {
    points.push_back({"mean = (2^" + std::to_string(k) + " - 1)/3",
                      {around(FormulaNumber((power_of_two(k) - 1) / 3)), 0}});
  }
  return points;
}

// In a range of exponents that the sum does not leave.
FormulaNumbers log_sum_exp_truth(const FormulaInput& in) {
  FormulaNumber sum(0);
  for (const auto& x : in.x) sum += exp(x);
  return {FormulaNumber(log(sum))};
}

std::vector<FormulaForm> big_pair_forms() {
  return {{"naive"}, {"kahan"}, {"neumaier"}};
}

std::vector<FormulaForm> variance_forms(const std::string& types, const std::string& cause) {
  return {{"one_pass", {{types, StressVerdict::unstable, cause}}}, {"two_pass"}, {"welford"}};
}

std::vector<FormulaForm> log_sum_exp_forms(const std::string& types, const std::string& cause) {
  return {{"naive", {{types, StressVerdict::diverged, cause}}}, {"shifted"}};
}

}  // namespace

std::vector<FormulaProblem> sum_problems() {
  return {
      {.name = "big_pair_1e100",
       .title = "1 + 1e100 + 1 - 1e100, 2; naive and Kahan's sum 0, Neumaier's 2; condition 1e100",
       .at = "x = 1, 1e100, 1, -1e100",
       .input = stated({"1", "1e100", "1", "-1e100"}),
       .truth = sum_truth,
       .forms = big_pair_forms()},
      {.name = "big_pair",
       .title = "1 + 2/u + 1 - 2/u, 2, with the unit roundoff u of the type",
       .at = "x = 1, 2/u, 1, -2/u",
       .input =
           [](const FloatFormat& f) {
             const FormulaNumber big = power_of_two(f.precision + 1);
             return FormulaInput{{FormulaNumber(1), big, FormulaNumber(1), FormulaNumber(-big)}, 0};
           },
       .truth = sum_truth,
       .forms = big_pair_forms()},
      {.name = "harmonic_sum",
       .title = "1 + 1/2 + ... of 4e6 terms; in float it stalls at 2097152",
       .at = "n = 4000000",
       .input = stated({}, 4000000),
       .truth = harmonic_truth,
       .forms = {{"naive",
                  {{"float,double", StressVerdict::unstable,
                    "of the method: every addition rounds the sum so far, and float's stalls at 2^21 terms"}},
                  "stall"},
                 {"neumaier",
                  {{"float", StressVerdict::unstable,
                    "of the method: the lost parts are summed naively, and n u is 0.24 in float"}}},
                 {"kahan"}},
       .types = "float,double",
       .referenced = false,
       .cost = 0.1},
      {.name = "variance_1e9",
       .title = "sample variance of 1e9 + {4, 7, 13, 16}, 30; -170 in double",
       .at = "mean 1e9 + 10",
       .input =
           [](const FloatFormat&) {
             return FormulaInput{around(FormulaNumber(1000000000)), 0};
           },
       .truth = variance_truth,
       .forms =
           variance_forms("double", "of the method: squares of 60 bits are rounded, and their sums cancel"),
       .meant = Meant::as_stated},
      {.name = "variance_far_mean",
       .title = "sample variance of {4, 7, 13, 16} and a mean of 3/4 of the type's bits",
       .at = "mean of 3/4 of the bits",
       .input =
           [](const FloatFormat& f) {
             return FormulaInput{around(power_of_two(3 * f.precision / 4)), 0};
           },
       .truth = variance_truth,
       .forms = variance_forms("all", "of the method: squares of 3/2 of the type's bits are rounded"),
       .meant = Meant::as_stated,
       .scan = scan_means},
      {.name = "log_sum_exp_1000",
       .title = "log(e^1000 + e^1000), 1000.69; infinite in double",
       .at = "x = 1000, 1000",
       .input = stated({"1000", "1000"}),
       .truth = log_sum_exp_truth,
       .forms = log_sum_exp_forms("float,double", "of the type's range: e^1000 is no number of it")},
      {.name = "log_sum_exp_at_overflow",
       .title = "log(e^x + e^x) at twice the logarithm of the largest number",
       .at = "x = 2 log max",
       .input =
           [](const FloatFormat& f) {
             const FormulaNumber x(2 * log(largest_of(f)));
             return FormulaInput{{x, x}, 0};
           },
       .truth = log_sum_exp_truth,
       .forms =
           log_sum_exp_forms("all", "of the method: exponentials overflow, their sum's logarithm does not")},
  };
}

}  // namespace ulpgate
