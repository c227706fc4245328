// Exact values of the special functions.
#include "reference/oracle/oracle_special.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
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

// sum_k t_k of t_0 = 1, t_(k+1) = -t_k x (n - k) / ((k + 1)(m + k + 1)): L_n^m(x) / C(n + m, n).  Returns how
// many of the sum's bits are lost: a term has three roundings for each before it, the sums n + 1 together,
// all of them relative to the largest term.
long laguerre_sum(long n, long m, mpfr_srcptr x, MpfrValue& sum) {
  MpfrValue term(mpfr_get_prec(sum));
  mpfr_set_ui(term, 1, nearest);
  mpfr_set_ui(sum, 1, nearest);
  mpfr_exp_t largest = 1;
  for (long k = 0; k < n; ++k) {
    mpfr_mul(term, term, x, nearest);
    mpfr_mul_si(term, term, k - n, nearest);
    mpfr_div_ui(term, term, static_cast<unsigned long>((k + 1) * (m + k + 1)), nearest);
    mpfr_add(sum, sum, term, nearest);
    if (mpfr_regular_p(term.get())) largest = std::max(largest, mpfr_get_exp(term.get()));
  }
  if (mpfr_regular_p(sum.get()) == 0) return mpfr_get_prec(sum);
  const auto size = static_cast<unsigned long>(n + 1);
  return largest - mpfr_get_exp(sum.get()) + 2 * static_cast<long>(std::bit_width(size)) + 3;
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
  // Terms of both signs cancel to about e^(-2 sqrt(n x)) of them, far beyond the zeros hardly.
  const double x = mpfr_get_d(a[2], nearest);
  const long wanted = mpfr_get_prec(out[0]) + 16;
  const auto most = static_cast<double>(8 * n + 4 * m);
  long bits =
      wanted + 32 + (x > 0 && x < most ? static_cast<long>(2.9 * std::sqrt(static_cast<double>(n) * x)) : 0);
  // Of an exact zero all bits are lost at any precision, and what is not one is a whole number over a power
  // of two and n!, with no more bits than this for arguments of usual size.
  constexpr long most_bits = 1L << 17U;
  MpfrValue sum(bits);
  long lost = laguerre_sum(n, m, a[2], sum);
  while (bits - lost < wanted && bits < most_bits && mpfr_inexflag_p() != 0) {
    bits = std::min(most_bits, lost >= bits ? 2 * bits : wanted + lost + 16);
    mpfr_set_prec(sum, bits);
    mpfr_clear_inexflag();
    lost = laguerre_sum(n, m, a[2], sum);
  }
  if (lost >= bits) mpfr_set_zero(sum, 1);
  mpz_t binomial;
  mpz_init(binomial);
  mpz_bin_uiui(binomial, static_cast<unsigned long>(n + m), static_cast<unsigned long>(n));
  mpfr_mul_z(out[0], sum, binomial, nearest);
  mpz_clear(binomial);
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
  // What both parts share, and e^(i m phi); Y_n^-m = (-1)^m conj(Y_n^m).
  const long bits = mpfr_get_prec(out[0]) + 32;
  MpfrValue legendre(bits);
  by_agreement(legendre, [&](long, MpfrValue& value) { normalized_legendre(n, order, a[2], value); });
  MpfrValue angle(mpfr_get_prec(a[3].get()) + 16);  // exact
  MpfrValue s(bits);
  MpfrValue c(bits);
  mpfr_mul_si(angle, a[3], order, nearest);
  mpfr_sin_cos(s, c, angle, nearest);
  mpfr_mul(out[0], legendre, c, nearest);
  mpfr_mul(out[1], legendre, s, nearest);
  if (m < 0) {
    MpfrValue& other = order % 2 == 1 ? out[0] : out[1];
    mpfr_neg(other, other, nearest);
  }
}

}  // namespace ulpgate::oracle
