// Condition numbers of functions at a point.
#include "reference/condition/condition.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace ulpgate {

namespace {

std::vector<MpfrValue> values(int n, long bits) {
  std::vector<MpfrValue> v;
  v.reserve(static_cast<std::size_t>(n));
  for (int i = 0; i < n; ++i) v.emplace_back(bits);
  return v;
}

// A step must be far below the period of a function that turns with its arguments: as many bits as the
// largest has before its point.
long periodic_bits(const FunctionInfo& f, std::span<const MpfrValue> args) {
  if (f.function_class == FunctionClass::real && f.hard != HardFamily::trig) return 0;
  long most = 0;
  for (const auto& x : args) {
    if (mpfr_regular_p(x.get())) most = std::max(most, static_cast<long>(mpfr_get_exp(x.get())));
  }
  return most;
}

}  // namespace

double condition_number(const FunctionInfo& f, std::span<const MpfrValue> args, int part, long bits) {
  const WideExponentRange wide;
  const long step_bits = bits + 32 + periodic_bits(f, args);
  // The difference loses step_bits; 96 are left for a condition number of 1.
  const long work_bits = step_bits + 96;
  const auto p = static_cast<std::size_t>(part);
  auto centre = values(f.parts, work_bits);
  auto above = values(f.parts, work_bits);
  auto below = values(f.parts, work_bits);
  auto shifted = values(f.arity, 2 * step_bits + 64);
  exact_value(f, args, centre);
  if (!mpfr_number_p(centre[p])) return std::numeric_limits<double>::quiet_NaN();

  MpfrValue sum(work_bits);
  MpfrValue term(work_bits);
  mpfr_set_zero(sum, 1);
  for (std::size_t i = 0; i < static_cast<std::size_t>(f.arity); ++i) {
    if (f.domain[i] == DomainMap::UINT || f.domain[i] == DomainMap::INT || mpfr_zero_p(args[i])) continue;
    const auto evaluate_at = [&](int direction, std::vector<MpfrValue>& out) {
      for (std::size_t j = 0; j < shifted.size(); ++j) mpfr_set(shifted[j], args[j], MPFR_RNDN);
      mpfr_set_si_2exp(term, direction, -step_bits, MPFR_RNDN);
      mpfr_add_ui(term, term, 1, MPFR_RNDN);
      mpfr_mul(shifted[i], shifted[i], term, MPFR_RNDN);
      exact_value(f, shifted, out);
      return mpfr_number_p(out[p]) != 0;
    };
    const bool has_above = evaluate_at(1, above);
    const bool has_below = evaluate_at(-1, below);
    if (!has_above && !has_below) return std::numeric_limits<double>::infinity();
    // x df/dx with the relative step h is (f(x(1+h)) - f(x(1-h))) / 2h.
    mpfr_sub(term, has_above ? above[p] : centre[p], has_below ? below[p] : centre[p], MPFR_RNDN);
    mpfr_mul_2si(term, term, step_bits - (has_above && has_below ? 1 : 0), MPFR_RNDN);
    mpfr_abs(term, term, MPFR_RNDN);
    mpfr_add(sum, sum, term, MPFR_RNDN);
  }
  if (mpfr_zero_p(sum)) return 0;
  mpfr_div(sum, sum, centre[p], MPFR_RNDN);
  return std::fabs(mpfr_get_d(sum, MPFR_RNDN));
}

}  // namespace ulpgate
