// Exact values of the special functions.
#include "reference/oracle/oracle_special.hpp"

#include <array>
#include <cstdlib>
#include <vector>

namespace ulpgate::oracle {

namespace {

constexpr auto nearest = MPFR_RNDN;

// Runs compute(working precision, result) at rising precision until two successive results agree to 16 bits
// beyond the wanted ones.  A result that stays zero up to the last precision is zero.
template <class Compute>
void by_agreement(MpfrValue& out, Compute&& compute) {
  const long wanted = mpfr_get_prec(out);
  MpfrValue previous(wanted);
  bool have_previous = false;
  long bits = wanted + 64;
  for (int attempt = 0; attempt < 8; ++attempt, bits += bits / 2) {
    MpfrValue current(bits);
    compute(bits, current);
    if (have_previous) {
      MpfrValue difference(64);
      mpfr_sub(difference, current, previous, nearest);
      const bool agree = mpfr_zero_p(difference) || !mpfr_number_p(current.get()) ||
                         (mpfr_regular_p(current.get()) &&
                          mpfr_get_exp(difference.get()) < mpfr_get_exp(current.get()) - wanted - 16);
      if (agree) {
        mpfr_set(out, current, nearest);
        return;
      }
    }
    mpfr_set_prec(previous, bits);
    mpfr_set(previous, current, nearest);
    have_previous = true;
  }
  mpfr_set(out, previous, nearest);
}

long integer(const MpfrValue& x) {
  return mpfr_get_si(x, nearest);
}

void laguerre_sum(long n, long m, mpfr_srcptr x, MpfrValue& sum) {
  const long bits = mpfr_get_prec(sum);
  MpfrValue power(bits);  // (-x)^k / k!
  MpfrValue term(bits);
  mpz_t binomial;
  mpz_init(binomial);
  mpfr_set_ui(power, 1, nearest);
  mpfr_set_zero(sum, 1);
  for (long k = 0; k <= n; ++k) {
    mpz_bin_uiui(binomial, static_cast<unsigned long>(n + m), static_cast<unsigned long>(n - k));
    mpfr_mul_z(term, power, binomial, nearest);
    mpfr_add(sum, sum, term, nearest);
    mpfr_mul(power, power, x, nearest);
    mpfr_div_si(power, power, -(k + 1), nearest);
  }
  mpz_clear(binomial);
}

// sqrt((2n+1)/(4 pi) (n-m)!/(n+m)!) P_n^m(cos theta) for 0 <= m <= n, by the upward recurrence in the degree
// (DLMF 14.10.3), which is stable because P_n^m is the dominant solution.
void normalized_legendre(long n, long m, mpfr_srcptr theta, MpfrValue& result) {
  const long bits = mpfr_get_prec(result);
  MpfrValue s(bits);
  MpfrValue c(bits);
  mpfr_sin_cos(s, c, theta, nearest);
  MpfrValue before(bits);  // P_{l-1}^m
  MpfrValue now(bits);     // P_l^m
  MpfrValue next(bits);
  mpfr_set_zero(before, 1);
  // P_m^m = (-1)^m (2m-1)!! sin^m theta
  mpfr_set_ui(now, 1, nearest);
  for (long i = 1; i <= m; ++i) {
    mpfr_mul(now, now, s, nearest);
    mpfr_mul_si(now, now, -(2 * i - 1), nearest);
  }
  for (long l = m; l < n; ++l) {
    mpfr_mul(next, now, c, nearest);
    mpfr_mul_si(next, next, 2 * l + 1, nearest);
    mpfr_mul_si(before, before, l + m, nearest);
    mpfr_sub(next, next, before, nearest);
    mpfr_div_si(next, next, l - m + 1, nearest);
    mpfr_swap(before, now);
    mpfr_swap(now, next);
  }
  mpz_t ratio;
  mpz_init_set_ui(ratio, 1);
  for (long i = n - m + 1; i <= n + m; ++i) mpz_mul_ui(ratio, ratio, static_cast<unsigned long>(i));
  mpfr_const_pi(s, nearest);
  mpfr_mul_ui(s, s, 4, nearest);
  mpfr_mul_z(s, s, ratio, nearest);
  mpz_clear(ratio);
  mpfr_ui_div(s, static_cast<unsigned long>(2 * n + 1), s, nearest);
  mpfr_sqrt(s, s, nearest);
  mpfr_mul(result, now, s, nearest);
}

}  // namespace

void cyl_bessel_j(std::span<const MpfrValue> a, std::span<MpfrValue> out) {
  mpfr_jn(out[0], integer(a[0]), a[1], nearest);
}

void factorial(std::span<const MpfrValue> a, std::span<MpfrValue> out) {
  mpfr_fac_ui(out[0], static_cast<unsigned long>(integer(a[0])), nearest);
}

void laguerre(std::span<const MpfrValue> a, std::span<MpfrValue> out) {
  const long n = integer(a[0]);
  const long m = integer(a[1]);
  if (!mpfr_number_p(a[2])) {
    // The leading term decides at infinities; a constant polynomial ignores its argument unless it is NaN.
    if (mpfr_nan_p(a[2])) return mpfr_set_nan(out[0]);
    if (n == 0) {
      mpfr_set_ui(out[0], 1, nearest);
    } else {
      mpfr_set_inf(out[0], mpfr_sgn(a[2].get()) > 0 && n % 2 == 1 ? -1 : 1);
    }
    return;
  }
  by_agreement(out[0], [&](long, MpfrValue& sum) { laguerre_sum(n, m, a[2], sum); });
}

void spherical_harmonic(std::span<const MpfrValue> a, std::span<MpfrValue> out) {
  const long n = integer(a[0]);
  const long m = integer(a[1]);
  const long order = std::labs(m);
  if (order > n) {
    mpfr_set_zero(out[0], 1);
    mpfr_set_zero(out[1], 1);
    return;
  }
  const auto part = [&](MpfrValue& result, bool imaginary) {
    by_agreement(result, [&](long bits, MpfrValue& value) {
      normalized_legendre(n, order, a[2], value);
      MpfrValue angle(bits + 64);
      MpfrValue factor(bits);
      // e^(i m phi); Y_n^-m = (-1)^m conj(Y_n^m).
      mpfr_mul_si(angle, a[3], order, nearest);
      if (imaginary) {
        mpfr_sin(factor, angle, nearest);
      } else {
        mpfr_cos(factor, angle, nearest);
      }
      mpfr_mul(value, value, factor, nearest);
      if (m < 0 && (order % 2 == 1) != imaginary) mpfr_neg(value, value, nearest);
    });
  };
  part(out[0], false);
  part(out[1], true);
}

}  // namespace ulpgate::oracle
