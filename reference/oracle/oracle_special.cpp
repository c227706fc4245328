// Exact values of the special functions.
#include "reference/oracle/oracle_special.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdlib>

#include "reference/oracle/oracle_angles.hpp"

namespace ulpgate::oracle {

namespace {

constexpr auto nearest = MPFR_RNDN;

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
  // Where n |x| < 1/2 each term is below half of the one before it.
  const bool falls =
      mpfr_regular_p(x) != 0 &&
      mpfr_get_exp(x) + static_cast<mpfr_exp_t>(std::bit_width(static_cast<unsigned long>(n))) < 0;
  for (long k = 0; k < n; ++k) {
    mpfr_mul(term, term, x, nearest);
    mpfr_mul_si(term, term, k - n, nearest);
    mpfr_div_ui(term, term, static_cast<unsigned long>((k + 1) * (m + k + 1)), nearest);
    mpfr_add(sum, sum, term, nearest);
    if (mpfr_regular_p(term.get())) largest = std::max(largest, mpfr_get_exp(term.get()));
    if (falls && mpfr_get_exp(term.get()) < -mpfr_get_prec(sum) - 2) break;
  }
  if (mpfr_regular_p(sum.get()) == 0) return mpfr_get_prec(sum);
  const auto size = static_cast<unsigned long>(n + 1);
  return largest - mpfr_get_exp(sum.get()) + 2 * static_cast<long>(std::bit_width(size)) + 3;
}

// C_(n-m)^(m+1/2)(c) = P_n^m(c) / P_m^m(c) by the recurrence in the degree (DLMF 14.10.3), whose first number
// is 1. Returns how many of its bits are lost: bounds of errors are passed on from step to step, in units of
// 2^-bits, where c has one of itself, a product and a difference one each.
long gegenbauer(long n, long m, mpfr_srcptr c, MpfrValue& now) {
  const mpfr_prec_t bits = mpfr_get_prec(now);
  const auto size = [](mpfr_srcptr x) {
    return mpfr_regular_p(x) == 0 ? 0.0L : std::ldexp(1.0L, static_cast<int>(mpfr_get_exp(x)));
  };
  MpfrValue before(bits);
  MpfrValue next(bits);
  mpfr_set_zero(before, 1);
  mpfr_set_ui(now, 1, nearest);
  const long double size_of_c = size(c);
  long double error = 0;
  long double error_before = 0;
  for (long l = m; l < n; ++l) {
    const auto first = static_cast<long double>(2 * l + 1) * size_of_c * (error + 4 * size(now));
    const auto second = static_cast<long double>(l + m) * (error_before + size(before));
    mpfr_mul(next, now, c, nearest);
    mpfr_mul_si(next, next, 2 * l + 1, nearest);
    mpfr_mul_si(before, before, l + m, nearest);
    mpfr_sub(next, next, before, nearest);
    const long double of_difference = size(next);
    mpfr_div_si(next, next, l - m + 1, nearest);
    error_before = error;
    error = 1.01L * ((first + second + of_difference) / static_cast<long double>(l - m + 1) + size(next));
    mpfr_swap(before, now);
    mpfr_swap(now, next);
  }
  if (error == 0) return 0;
  if (mpfr_regular_p(now.get()) == 0 || !std::isfinite(error)) return bits;
  return std::ilogb(error) + 2 - static_cast<long>(mpfr_get_exp(now.get()));
}

// sqrt((2n+1)/(4 pi) (n-m)!/(n+m)!) P_n^m(cos theta) for 0 <= m <= n, within 2^-16 ulp before its last
// rounding.
void normalized_legendre(long n, long m, mpfr_srcptr theta, MpfrValue& result) {
  const long wanted = mpfr_get_prec(result) + 32;
  // Bounds grow like the recurrence without its signs: for m = 0 by this much from step to step.
  const double z = std::fabs(std::cos(mpfr_get_d(theta, nearest)));
  const double growth = std::isfinite(z) ? std::log2(z + std::sqrt(1 + z * z)) : 0;
  long bits = wanted + 16 + static_cast<long>(growth * static_cast<double>(n - m));
  constexpr long most_bits = 1L << 17U;
  MpfrValue s(bits), c(bits), value(bits);
  while (true) {
    sine_and_cosine(s, c, theta);
    const long lost = gegenbauer(n, m, c, value);
    if (bits - lost >= wanted || bits >= most_bits || mpfr_nan_p(value.get()) != 0) break;
    bits = std::min(most_bits, lost >= bits ? 2 * bits : wanted + lost + 16);
    for (MpfrValue* x : {&s, &c, &value}) mpfr_set_prec(*x, bits);
  }
  // P_m^m = (-1)^m (2m-1)!! sin^m theta; m errors of the sine.
  mpfr_pow_ui(s, s, static_cast<unsigned long>(m), nearest);
  mpfr_mul(value, value, s, nearest);
  if (m % 2 == 1) mpfr_neg(value, value, nearest);
  MpzValue product;
  mpz_set_ui(product, 1);
  for (long i = 3; i < 2 * m; i += 2) mpz_mul_ui(product, product, static_cast<unsigned long>(i));
  mpfr_mul_z(value, value, product, nearest);
  mpz_set_ui(product, 1);
  for (long i = n - m + 1; i <= n + m; ++i) mpz_mul_ui(product, product, static_cast<unsigned long>(i));
  mpfr_const_pi(c, nearest);
  mpfr_mul_ui(c, c, 4, nearest);
  mpfr_mul_z(c, c, product, nearest);
  mpfr_ui_div(c, static_cast<unsigned long>(2 * n + 1), c, nearest);
  mpfr_sqrt(c, c, nearest);
  mpfr_mul(result, value, c, nearest);
}

// J_n(x) by the first term of Hankel's series, sqrt(2 / (pi x)) cos(x - n pi/2 - pi/4) (DLMF 10.17.3), for x
// so large that the second one, (4n^2 - 1) / (8x) of it, is nothing: 2^-200 of an ulp, for sines and cosines
// that lose up to 200 bits.  False for other x.
bool far_bessel(mpfr_ptr out, long n, mpfr_srcptr x) {
  constexpr long spare = 200;
  const mpfr_prec_t bits = mpfr_get_prec(out) + 32;
  const auto order = static_cast<long>(std::bit_width(static_cast<unsigned long>(n)));
  if (mpfr_regular_p(x) == 0 || mpfr_get_exp(x) < bits + 2 * order + 2 * spare) return false;
  MpfrValue size(mpfr_get_prec(x)), s(bits + spare), c(bits + spare), wave(bits);
  mpfr_abs(size, x, nearest);
  sine_and_cosine(s, c, size);
  // sqrt(2) cos(x - n pi/2 - pi/4) is cos x + sin x, sin x - cos x and the negatives of these in turn.
  if (n % 2 == 0) {
    mpfr_add(wave, c, s, nearest);
  } else {
    mpfr_sub(wave, s, c, nearest);
  }
  if (mpfr_regular_p(wave.get()) == 0 || mpfr_get_exp(wave.get()) < -spare) return false;
  const bool turned = n % 4 == 2 || n % 4 == 3;
  const bool mirrored = n % 2 == 1 && mpfr_sgn(x) < 0;
  if (turned != mirrored) mpfr_neg(wave, wave, nearest);
  MpfrValue width(bits);
  mpfr_const_pi(width, nearest);
  mpfr_mul(width, width, size, nearest);
  mpfr_sqrt(width, width, nearest);
  mpfr_div(out, wave, width, nearest);
  return true;
}

// sum_k t_k of t_0 = 1, t_(k+1) = -t_k q / ((k + 1)(n + k + 1)), q = x^2/4: J_n(x) / ((x/2)^n / n!)
// (DLMF 10.2.2). Returns how many of the sum's bits are lost: a term has three roundings for each before it
// and a sum one, all relative to the largest term; where terms fall, what is left out is less than the first
// of it (Leibniz).
long bessel_sum(unsigned long n, mpfr_srcptr q, MpfrValue& sum) {
  const mpfr_prec_t bits = mpfr_get_prec(sum);
  MpfrValue term(bits);
  mpfr_set_ui(term, 1, nearest);
  mpfr_set_ui(sum, 1, nearest);
  mpfr_exp_t largest = 1;
  unsigned long k = 0;
  do {
    mpfr_mul(term, term, q, nearest);
    ++k;
    mpfr_div_ui(term, term, k * (n + k), nearest);
    mpfr_neg(term, term, nearest);
    mpfr_add(sum, sum, term, nearest);
    largest = std::max(largest, mpfr_get_exp(term.get()));
  } while (mpfr_get_exp(term.get()) > largest - bits - 2 || mpfr_cmp_ui(q, k * (n + k)) > 0);
  if (mpfr_regular_p(sum.get()) == 0) return bits;
  return largest - mpfr_get_exp(sum.get()) + 2 * static_cast<long>(std::bit_width(k)) + 3;
}

// J_n(x) by its series, for x so small that it takes less than mpfr_jn.  False for other x.
bool near_bessel(mpfr_ptr out, long n, mpfr_srcptr x) {
  constexpr double greatest = 50;
  const double size = std::fabs(mpfr_get_d(x, nearest));
  if (mpfr_regular_p(x) == 0 || n < 0 || n > 1000 ||
      !(size < std::max(greatest, 2.0 * static_cast<double>(n))))
    return false;
  const long wanted = mpfr_get_prec(out) + 16;
  // Of all terms' sum, I_n(x) / ((x/2)^n / n!), to that of their signs: e^(2q / (n + 1)) for small x, e^x for
  // large ones.
  const double cancels = std::min(0.72 * size * size / static_cast<double>(n + 1), 1.45 * size);
  long bits = wanted + 24 + static_cast<long>(cancels);
  MpfrValue sum(bits), q(bits);
  while (true) {
    mpfr_sqr(q, x, nearest);
    mpfr_div_2ui(q, q, 2, nearest);
    const long lost = bessel_sum(static_cast<unsigned long>(n), q, sum);
    if (bits - lost >= wanted) break;
    bits = lost >= bits ? 2 * bits : wanted + lost + 16;
    mpfr_set_prec(sum, bits);
    mpfr_set_prec(q, bits);
  }
  MpfrValue power(wanted + 16);
  mpfr_pow_ui(power, x, static_cast<unsigned long>(n), nearest);
  mpfr_div_2ui(power, power, static_cast<unsigned long>(n), nearest);
  mpfr_mul(power, power, sum, nearest);
  MpzValue product;
  mpz_fac_ui(product, static_cast<unsigned long>(n));
  mpfr_div_z(out, power, product, nearest);
  return true;
}

}  // namespace

void cyl_bessel_j(std::span<const MpfrValue> a, std::span<MpfrValue> out) {
  const long n = integer(a[0]);
  if (!near_bessel(out[0], n, a[1]) && !far_bessel(out[0], n, a[1])) mpfr_jn(out[0], n, a[1], nearest);
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
  MpzValue binomial;
  mpz_bin_uiui(binomial, static_cast<unsigned long>(n + m), static_cast<unsigned long>(n));
  mpfr_mul_z(out[0], sum, binomial, nearest);
}

bool is_rounded_laguerre(std::span<const MpfrValue> a, mpfr_srcptr value) {
  const auto last_bit = [](mpfr_srcptr x) { return static_cast<long>(mpfr_get_exp(x) - mpfr_min_prec(x)); };
  mpfr_srcptr x = a[2];
  const long n = integer(a[0]);
  if (n < 1 || mpfr_regular_p(x) == 0 || mpfr_regular_p(value) == 0) return false;
  if (n == 1) {
    MpfrValue sum(mpfr_get_prec(value));
    const int ternary = mpfr_si_sub(sum, 1 + integer(a[1]), x, nearest);
    return ternary != 0 || mpfr_equal_p(sum, value) == 0;
  }
  return last_bit(x) < 0 && last_bit(value) != last_bit_of_laguerre(n, last_bit(x));
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
  normalized_legendre(n, order, a[2], legendre);
  MpfrValue angle(mpfr_get_prec(a[3].get()) + 16);  // exact
  MpfrValue s(bits);
  MpfrValue c(bits);
  mpfr_mul_si(angle, a[3], order, nearest);
  sine_and_cosine(s, c, angle);
  mpfr_mul(out[0], legendre, c, nearest);
  mpfr_mul(out[1], legendre, s, nearest);
  if (m < 0) {
    MpfrValue& other = order % 2 == 1 ? out[0] : out[1];
    mpfr_neg(other, other, nearest);
  }
}

}  // namespace ulpgate::oracle
