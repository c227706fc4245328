// Constants and tables of DoubleDouble numbers, by MPFR.
#include "reference/multi_word/constants.hpp"

#include "reference/types/mpfr_value.hpp"

namespace ulpgate::multi_word {

namespace {

constexpr mpfr_prec_t bits = 400;

// The words of x, from the leading one on.
template <class Word>
Word rounded(mpfr_srcptr x) {
  MpfrValue rest(mpfr_get_prec(x));
  mpfr_set(rest, x, MPFR_RNDN);
  const auto next = [&] {
    const double word = mpfr_get_d(rest, MPFR_RNDN);
    mpfr_sub_d(rest, rest, word, MPFR_RNDN);
    return word;
  };
  Word word;
  word.hi = next();
  if constexpr (Constants<Word>::words == 3) word.mid = next();
  word.lo = next();
  return word;
}

// The leading `digits` bits of x, which is lessened by them.
double piece(mpfr_ptr x, mpfr_prec_t digits) {
  MpfrValue part(digits);
  mpfr_set(part, x, MPFR_RNDZ);
  mpfr_sub(x, x, part, MPFR_RNDN);
  return mpfr_get_d(part, MPFR_RNDN);
}

template <class Word>
void make_exponentials(Constants<Word>& c) {
  MpfrValue x(bits);
  mpfr_const_log2(x, MPFR_RNDN);
  c.ln2 = rounded<Word>(x);
  mpfr_ui_div(x, 1, x, MPFR_RNDN);
  c.inverse_ln2 = rounded<Word>(x);
  c.inverse_ln2_64 = 64 * c.inverse_ln2.hi;
  mpfr_const_log2(x, MPFR_RNDN);
  mpfr_div_2ui(x, x, 6, MPFR_RNDN);
  for (double& part : c.ln2_64) part = piece(x, &part == c.ln2_64.data() ? Constants<Word>::first_bits : 53);
  mpfr_set_ui(x, 10, MPFR_RNDN);
  mpfr_log(x, x, MPFR_RNDN);
  mpfr_ui_div(x, 1, x, MPFR_RNDN);
  c.inverse_ln10 = rounded<Word>(x);
  for (std::size_t i = 0; i < c.power.size(); ++i) {
    mpfr_set_si_2exp(x, static_cast<long>(i) - 32, -6, MPFR_RNDN);
    mpfr_exp2(x, x, MPFR_RNDN);
    c.power[i] = rounded<Word>(x);
    mpfr_sub_ui(x, x, 1, MPFR_RNDN);
    c.power_less_1[i] = rounded<Word>(x);
  }
}

template <class Word>
void make_logarithms(Constants<Word>& c) {
  MpfrValue scale(11);
  MpfrValue x(bits);
  for (std::size_t i = 0; i < c.log_scale.size(); ++i) {
    mpfr_set_ui(scale, 128, MPFR_RNDN);
    mpfr_div_ui(scale, scale, i + least_log_index, MPFR_RNDN);
    c.log_scale[i] = mpfr_get_d(scale, MPFR_RNDN);
    mpfr_log(x, scale, MPFR_RNDN);
    mpfr_neg(x, x, MPFR_RNDN);
    c.log_of_scale[i] = rounded<Word>(x);
  }
}

template <class Word>
void make_angles(Constants<Word>& c) {
  MpfrValue x(bits);
  mpfr_const_pi(x, MPFR_RNDN);
  c.pi_word = rounded<Word>(x);
  mpfr_div_2ui(x, x, 1, MPFR_RNDN);
  c.half_pi_word = rounded<Word>(x);
  for (double& part : c.half_pi) part = piece(x, 53);
  MpfrValue cosine(bits);
  for (std::size_t i = 0; i < c.sine.size(); ++i) {
    mpfr_set_ui_2exp(x, i, -5, MPFR_RNDN);
    mpfr_sin_cos(x, cosine, x, MPFR_RNDN);
    c.sine[i] = rounded<Word>(x);
    c.cosine[i] = rounded<Word>(cosine);
  }
  for (std::size_t i = 0; i < c.angle.size(); ++i) {
    mpfr_set_ui_2exp(x, i, -5, MPFR_RNDN);
    mpfr_atan(x, x, MPFR_RNDN);
    c.angle[i] = rounded<Word>(x);
  }
  const auto words = c.two_over_pi.size();
  MpfrValue long_one(static_cast<mpfr_prec_t>(64 * words + 64));
  mpfr_const_pi(long_one, MPFR_RNDN);
  mpfr_ui_div(long_one, 2, long_one, MPFR_RNDN);
  c.inverse_half_pi = mpfr_get_d(long_one, MPFR_RNDN);
  MpfrValue whole(64);
  for (std::uint64_t& word : c.two_over_pi) {
    mpfr_mul_2ui(long_one, long_one, 64, MPFR_RNDN);
    mpfr_set(whole, long_one, MPFR_RNDZ);
    mpfr_trunc(whole, whole);
    word = mpfr_get_ui(whole, MPFR_RNDZ);
    mpfr_sub(long_one, long_one, whole, MPFR_RNDN);
  }
}

template <class Word>
void make_series(Constants<Word>& c) {
  MpfrValue x(bits);
  // sign / n!, and sign / n
  const auto of_factorial = [&](int sign, std::size_t n) {
    mpfr_fac_ui(x, n, MPFR_RNDN);
    mpfr_si_div(x, sign, x, MPFR_RNDN);
    return rounded<Word>(x);
  };
  const auto of_number = [&](int sign, std::size_t n) {
    mpfr_set_si(x, sign, MPFR_RNDN);
    mpfr_div_ui(x, x, n, MPFR_RNDN);
    return rounded<Word>(x);
  };
  const auto sign_of = [](std::size_t k) { return k % 2 == 0 ? 1 : -1; };
  for (std::size_t k = 0; k < c.inverse_factorial.size(); ++k) c.inverse_factorial[k] = of_factorial(1, k);
  for (std::size_t k = 0; k < c.sine_series.size(); ++k) {
    c.sine_series[k] = of_factorial(sign_of(k), 2 * k + 1);
    c.cosine_series[k] = of_factorial(sign_of(k), 2 * k);
  }
  for (std::size_t k = 1; k < c.log_series.size(); ++k) c.log_series[k] = of_number(-sign_of(k), k);
  for (std::size_t k = 0; k < c.atan_series.size(); ++k) {
    c.atanh_series[k] = of_number(1, 2 * k + 1);
    c.atan_series[k] = of_number(sign_of(k), 2 * k + 1);
  }
}

template <class Word>
void make_gamma(Constants<Word>& c) {
  MpfrValue x(bits);
  MpfrValue two_pi(bits);
  mpfr_const_pi(two_pi, MPFR_RNDN);
  mpfr_log(x, two_pi, MPFR_RNDN);
  c.log_pi = rounded<Word>(x);
  mpfr_mul_ui(two_pi, two_pi, 2, MPFR_RNDN);
  mpfr_log(x, two_pi, MPFR_RNDN);
  mpfr_div_ui(x, x, 2, MPFR_RNDN);
  c.log_sqrt_two_pi = rounded<Word>(x);
  // B_2k = (-1)^(k + 1) 2 (2k)! zeta(2k) / (2 pi)^2k, DLMF 25.6.2.
  MpfrValue factor(bits);
  for (unsigned long k = 1; k <= c.stirling.size(); ++k) {
    mpfr_zeta_ui(x, 2 * k, MPFR_RNDN);
    mpfr_fac_ui(factor, 2 * k, MPFR_RNDN);
    mpfr_mul(x, x, factor, MPFR_RNDN);
    mpfr_pow_ui(factor, two_pi, 2 * k, MPFR_RNDN);
    mpfr_div(x, x, factor, MPFR_RNDN);
    mpfr_mul_si(x, x, k % 2 == 1 ? 2 : -2, MPFR_RNDN);
    mpfr_div_ui(x, x, 2 * k * (2 * k - 1), MPFR_RNDN);
    c.stirling[k - 1] = rounded<Word>(x);
  }
}

// The coefficients a_n of y = e^(x^2) erfc x at a point: y' = 2 x y - 2 / sqrt(pi), so that (n + 1) a_(n+1) =
// 2 x a_n + 2 a_(n-1), and one more term for n = 0.  Forwards they lose some 2 bits a term: of 1000 enough
// are left.
template <class Word>
void make_scaled_erfc(Constants<Word>& c, mpfr_srcptr two_over_sqrt_pi) {
  constexpr mpfr_prec_t many = 1000;
  MpfrValue before(many);
  MpfrValue now(many);
  MpfrValue next(many);
  MpfrValue term(many);
  for (std::size_t i = 0; i < c.scaled_erfc.size(); ++i) {
    const double x = 1 + static_cast<double>(i) / 4;
    mpfr_set_zero(before, 1);
    mpfr_set_d(now, x, MPFR_RNDN);
    mpfr_erfc(now, now, MPFR_RNDN);
    mpfr_set_d(term, x * x, MPFR_RNDN);
    mpfr_exp(term, term, MPFR_RNDN);
    mpfr_mul(now, now, term, MPFR_RNDN);
    for (std::size_t n = 0; n < c.scaled_erfc[i].size(); ++n) {
      c.scaled_erfc[i][n] = rounded<Word>(now);
      mpfr_mul_d(next, now, 2 * x, MPFR_RNDN);
      mpfr_mul_ui(term, before, 2, MPFR_RNDN);
      mpfr_add(next, next, term, MPFR_RNDN);
      if (n == 0) mpfr_sub(next, next, two_over_sqrt_pi, MPFR_RNDN);
      mpfr_div_ui(next, next, n + 1, MPFR_RNDN);
      mpfr_swap(before, now);
      mpfr_swap(now, next);
    }
  }
}

template <class Word>
void make_error_functions(Constants<Word>& c) {
  MpfrValue x(1000);
  mpfr_const_pi(x, MPFR_RNDN);
  mpfr_rec_sqrt(x, x, MPFR_RNDN);
  c.inverse_sqrt_pi = rounded<Word>(x);
  mpfr_mul_ui(x, x, 2, MPFR_RNDN);
  c.two_over_sqrt_pi = rounded<Word>(x);
  make_scaled_erfc(c, x);
  for (unsigned long n = 0; n < c.erf_series.size(); ++n) {
    mpfr_fac_ui(x, n, MPFR_RNDN);
    mpfr_mul_ui(x, x, 2 * n + 1, MPFR_RNDN);
    mpfr_si_div(x, n % 2 == 0 ? 1 : -1, x, MPFR_RNDN);
    c.erf_series[n] = rounded<Word>(x);
  }
}

template <class Word>
Constants<Word> made() {
  Constants<Word> c{};
  make_exponentials(c);
  make_logarithms(c);
  make_angles(c);
  make_series(c);
  make_gamma(c);
  make_error_functions(c);
  return c;
}

}  // namespace

template <class Word>
const Constants<Word>& constants() {
  static const Constants<Word> c = made<Word>();
  return c;
}
template const Constants<DoubleDouble>& constants<DoubleDouble>();
template const Constants<TripleDouble>& constants<TripleDouble>();

}  // namespace ulpgate::multi_word
