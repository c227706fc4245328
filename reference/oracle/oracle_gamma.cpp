// Exact values of the gamma functions.
#include "reference/oracle/oracle_gamma.hpp"

#include <map>
#include <vector>

#include "reference/types/mpfr_value.hpp"

namespace ulpgate::oracle {

namespace {

constexpr auto nearest = MPFR_RNDN;

// The series is for |x| < 2^-8: there |ln|x|| > 5 exceeds it, so that nothing cancels.
constexpr mpfr_exp_t largest_exponent = -8;
constexpr long most_terms = 32;
constexpr long guard_bits = 40;

// The coefficients of ln Gamma(1 + x) = -g x + sum_(k >= 2) zeta(k)/k (-x)^k (DLMF 5.7.3), g Euler's
// constant, at one precision: [k - 1] belongs to x^k.  Each is made when first wanted.
class LogGammaSeries {
 public:
  explicit LogGammaSeries(long bits) : bits_(bits) {}

  // sum = ln Gamma(1 + x) by its first `terms` terms, off by at most 2 |x| (2^-bits + |x|^terms).
  void operator()(MpfrValue& sum, mpfr_srcptr x, long terms) {
    extend(terms);
    mpfr_set_zero(sum, 1);
    for (long k = terms; k >= 1; --k) {
      mpfr_add(sum, sum, coefficients_[static_cast<std::size_t>(k - 1)], nearest);
      mpfr_mul(sum, sum, x, nearest);
    }
  }

 private:
  void extend(long terms) {
    for (long k = static_cast<long>(coefficients_.size()) + 1; k <= terms; ++k) {
      MpfrValue c(bits_);
      if (k == 1) {
        mpfr_const_euler(c, nearest);
      } else {
        mpfr_zeta_ui(c, static_cast<unsigned long>(k), nearest);
        mpfr_div_si(c, c, k, nearest);
      }
      if (k % 2 != 0) mpfr_neg(c, c, nearest);
      coefficients_.push_back(std::move(c));
    }
  }

  long bits_;
  std::vector<MpfrValue> coefficients_;
};

LogGammaSeries& series_of(long bits) {
  // A run asks for two or three precisions.
  thread_local std::map<long, LogGammaSeries> all;
  return all.try_emplace(bits, bits).first->second;
}

long terms_of_series(mpfr_srcptr x, long bits) {
  return bits / -static_cast<long>(mpfr_get_exp(x)) + 1;
}

// Calls finish(value) with value = ln Gamma(1 + x) at more bits than out has; rounds what it then holds to
// out, if 32 of those bits beyond out's decide that and show that no value of out's precision or one bit more
// is met. `ternary` is then what MPFR would say.
template <class Finish>
bool by_series(mpfr_ptr out, mpfr_srcptr x, int& ternary, Finish&& finish) {
  if (!series_serves_gamma(x, mpfr_get_prec(out))) return false;
  const long bits = mpfr_get_prec(out) + guard_bits;
  MpfrValue value(bits);
  series_of(bits)(value, x, terms_of_series(x, bits));
  finish(value);
  // Five roundings and the cut series: under 2^4 ulp.
  if (mpfr_can_round(value, bits - 8, nearest, MPFR_RNDZ, mpfr_get_prec(out) + 1) == 0) return false;
  ternary = mpfr_set(out, value, nearest);
  return true;
}

}  // namespace

bool series_serves_gamma(mpfr_srcptr x, long bits) {
  return mpfr_regular_p(x) != 0 && mpfr_get_exp(x) <= largest_exponent &&
         terms_of_series(x, bits + guard_bits) <= most_terms;
}

RoundingMade gamma(mpfr_ptr out, mpfr_srcptr x) {
  int ternary = 0;
  const auto finish = [&](MpfrValue& value) {
    // Gamma(x) = Gamma(1 + x)/x.
    mpfr_exp(value, value, nearest);
    mpfr_div(value, value, x, nearest);
  };
  if (by_series(out, x, ternary, finish)) return {ternary, Method::formula};
  return {mpfr_gamma(out, x, nearest), Method::mpfr};
}

RoundingMade log_gamma(mpfr_ptr out, mpfr_srcptr x) {
  int ternary = 0;
  const auto finish = [&](MpfrValue& value) {
    MpfrValue log(mpfr_get_prec(value.get()));
    mpfr_abs(log, x, nearest);
    mpfr_log(log, log, nearest);
    mpfr_sub(value, value, log, nearest);
  };
  int sign = 0;
  if (by_series(out, x, ternary, finish)) return {ternary, Method::formula};
  return {mpfr_lgamma(out, &sign, x, nearest), Method::mpfr};
}

}  // namespace ulpgate::oracle
