// Exact values of the error functions.
//
// For x > 0 and w(t) = e^(-t^2) (Chiarella and Reichel, "On the evaluation of integrals related to the error
// function", Math. Comp. 22 (1968) 137; Hunter and Regan, Math. Comp. 26 (1972) 539)
//
//   erfc(x) = x e^(-x^2)/pi * h sum_(all n) w(nh) / (n^2 h^2 + x^2)  -  C  +  E,
//   C = 2 / (e^(2 pi x/h) - 1) where x < pi/h, 0 where x > pi/h.
//
// With a = pi/h the rule's error E is below e^(-a^2) 2 x (x + sqrt(x^2 + 2)) / |a^2 - x^2| of erfc(x): shift
// the integrals of Poisson's sum to Im t = a, and use erfc(x) >= 2 e^(-x^2) / (sqrt(pi) (x + sqrt(x^2 + 2)))
// (DLMF 7.8.2).  At |x - a| >= 0.4 that is under 16 (x + 1) e^(-a^2).  C is below 2 sqrt(pi) (x + 1) e^(x^2 -
// 2ax) of erfc(x), under 1 % at x >= 1: nothing cancels.
#include "reference/oracle/oracle_erf.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

#include "reference/types/mpfr_value.hpp"

namespace ulpgate::oracle {

namespace {

constexpr auto nearest = MPFR_RNDN;
constexpr long guard_bits = 40;
// Beyond it MPFR's asymptotic series serves, below it MPFR's Taylor series is short.
constexpr double least_argument = 1.5;
constexpr double greatest_argument = 64;
constexpr long greatest_precision = 6000;

// Bits by which e^(-t^2) is below 1.
double bits_below_one(double t) {
  return t * t * std::numbers::log2e;
}

// The rule for one step h: a = pi/h, and the weights w(nh).
class Trapezoids {
 public:
  // Good to `bits` bits with every x that is not within 0.4 of a.
  Trapezoids(long bits, double extra) : bits_(bits) {
    // 16 (x + 1) is below 2^11.
    const double a = std::sqrt(static_cast<double>(bits + 12) / std::numbers::log2e) + extra;
    step_ = std::numbers::pi / a;
    const auto count = static_cast<long>(std::ceil(a / step_));
    MpfrValue square(2 * 53 + 64);
    for (long n = 1; n <= count; ++n) {
      mpfr_set_d(square, step_, nearest);
      mpfr_mul_si(square, square, n, nearest);
      mpfr_sqr(square, square, nearest);
      // A small weight needs few bits.
      const long lost = static_cast<long>(bits_below_one(static_cast<double>(n) * step_));
      MpfrValue weight(std::max(bits - lost + 8, 64L));
      mpfr_neg(square, square, nearest);
      mpfr_exp(weight, square, nearest);
      mpfr_neg(square, square, nearest);
      MpfrValue copy(mpfr_get_prec(square.get()));
      mpfr_set(copy, square, nearest);
      weights_.push_back({std::move(copy), std::move(weight)});
    }
  }

  [[nodiscard]] bool serves(double x) const { return std::fabs(x - std::numbers::pi / step_) >= 0.4; }

  // out = erfc(x), 1 <= x <= 64, to its precision of at most `bits`, off by less than 2^11 of its ulps.
  void operator()(MpfrValue& out, mpfr_srcptr x) const {
    const mpfr_prec_t bits = mpfr_get_prec(out.get());
    MpfrValue square(2 * mpfr_get_prec(x));
    mpfr_sqr(square, x, nearest);  // exact
    MpfrValue sum(bits), denominator(bits), term(bits);
    const long spared = bits_ - static_cast<long>(bits);
    mpfr_ui_div(sum, 1, square, nearest);
    mpfr_div_2ui(sum, sum, 1, nearest);
    for (const auto& [node, weight] : weights_) {
      const long precision = static_cast<long>(mpfr_get_prec(weight.get())) - spared;
      if (precision <= 8 && spared > 0) break;
      mpfr_set_prec(denominator, std::max(precision, 64L));
      mpfr_set_prec(term, std::max(precision, 64L));
      mpfr_add(denominator, node, square, nearest);
      mpfr_div(term, weight, denominator, nearest);
      mpfr_add(sum, sum, term, nearest);
    }
    // 2 h x/pi e^(-x^2) sum
    mpfr_mul_d(sum, sum, 2 * step_, nearest);
    mpfr_mul(sum, sum, x, nearest);
    mpfr_neg(square, square, nearest);
    mpfr_set_prec(term, bits);
    mpfr_exp(term, square, nearest);
    mpfr_mul(sum, sum, term, nearest);
    MpfrValue pi(bits + 16);
    mpfr_const_pi(pi, nearest);
    mpfr_div(out, sum, pi, nearest);
    if (mpfr_get_d(x, nearest) * step_ > std::numbers::pi) return;
    mpfr_mul_ui(pi, pi, 2, nearest);
    mpfr_mul(pi, pi, x, nearest);
    mpfr_div_d(pi, pi, step_, nearest);
    mpfr_expm1(term, pi, nearest);
    mpfr_ui_div(term, 2, term, nearest);
    mpfr_sub(out, out, term, nearest);
  }

 private:
  long bits_;
  double step_ = 0;
  std::vector<std::pair<MpfrValue, MpfrValue>> weights_;  // (nh)^2, w(nh)
};

// erfc(x) for x that least_argument and greatest_argument allow, by a rule of at least the precision of
// `out`.
void erfc_by_rule(MpfrValue& out, mpfr_srcptr x, long rule_bits) {
  thread_local std::map<std::pair<long, bool>, Trapezoids> all;
  const auto rule = [&](bool wider) -> const Trapezoids& {
    return all.try_emplace({rule_bits, wider}, rule_bits, wider ? 1.0 : 0.0).first->second;
  };
  const Trapezoids& usual = rule(false);
  (usual.serves(mpfr_get_d(x, nearest)) ? usual : rule(true))(out, x);
}

// `value` is within 2^12 of its ulps: rounds it to out, if that decides out and shows that no value of out's
// precision or one bit more is met.
bool round_to(mpfr_ptr out, const MpfrValue& value, int& ternary) {
  const long bits = mpfr_get_prec(value.get());
  if (mpfr_can_round(value, bits - 12, nearest, MPFR_RNDZ, mpfr_get_prec(out) + 1) == 0) return false;
  ternary = mpfr_set(out, value, nearest);
  return true;
}

bool is_moderate(mpfr_srcptr x, long bits) {
  if (mpfr_regular_p(x) == 0 || bits > greatest_precision) return false;
  const double size = std::fabs(mpfr_get_d(x, MPFR_RNDN));
  return size >= least_argument && size <= greatest_argument;
}

// Bits of erfc(|x|) that reach into its sum with 1 or 2.
long bits_in_sum(mpfr_srcptr x, long rule_bits) {
  return rule_bits - static_cast<long>(bits_below_one(std::fabs(mpfr_get_d(x, nearest)))) + 2;
}

// Next to nothing is left to MPFR, which sees that.
bool serves_complement(mpfr_srcptr x, long bits) {
  return is_moderate(x, bits) && bits_in_sum(x, bits + guard_bits) >= guard_bits;
}

// base - erfc(|x|) for base 1 and 2, with the sign of x for base 1.
bool by_complement(mpfr_ptr out, mpfr_srcptr x, unsigned long base, int& ternary) {
  const long rule_bits = mpfr_get_prec(out) + guard_bits;
  MpfrValue positive(mpfr_get_prec(x));
  mpfr_abs(positive, x, nearest);
  MpfrValue small(std::min(bits_in_sum(x, rule_bits), rule_bits));
  erfc_by_rule(small, positive, rule_bits);
  MpfrValue value(rule_bits);
  mpfr_ui_sub(value, base, small, nearest);
  if (base == 1 && mpfr_sgn(x) < 0) mpfr_neg(value, value, nearest);
  return round_to(out, value, ternary);
}

bool by_rule(mpfr_ptr out, mpfr_srcptr x, int& ternary) {
  MpfrValue value(mpfr_get_prec(out) + guard_bits);
  erfc_by_rule(value, x, mpfr_get_prec(value.get()));
  return round_to(out, value, ternary);
}

}  // namespace

bool rule_serves_erf(mpfr_srcptr x, long bits) {
  return serves_complement(x, bits);
}

bool rule_serves_erfc(mpfr_srcptr x, long bits) {
  return mpfr_sgn(x) < 0 ? serves_complement(x, bits) : is_moderate(x, bits);
}

RoundingMade error_function(mpfr_ptr out, mpfr_srcptr x) {
  int ternary = 0;
  if (rule_serves_erf(x, mpfr_get_prec(out)) && by_complement(out, x, 1, ternary))
    return {ternary, Method::formula};
  return {mpfr_erf(out, x, nearest), Method::mpfr};
}

RoundingMade complementary_error_function(mpfr_ptr out, mpfr_srcptr x) {
  int ternary = 0;
  if (rule_serves_erfc(x, mpfr_get_prec(out)) &&
      (mpfr_sgn(x) < 0 ? by_complement(out, x, 2, ternary) : by_rule(out, x, ternary)))
    return {ternary, Method::formula};
  return {mpfr_erfc(out, x, nearest), Method::mpfr};
}

}  // namespace ulpgate::oracle
