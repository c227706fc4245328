// Constants and tables of DoubleDouble numbers, by MPFR.
#include "reference/double_double/constants.hpp"

#include "reference/types/mpfr_value.hpp"

namespace ulpgate::dd {

namespace {

constexpr mpfr_prec_t bits = 400;

DoubleDouble rounded(mpfr_srcptr x) {
  MpfrValue rest(bits);
  const double hi = mpfr_get_d(x, MPFR_RNDN);
  mpfr_sub_d(rest, x, hi, MPFR_RNDN);
  return {hi, mpfr_get_d(rest, MPFR_RNDN)};
}

// The leading `digits` bits of x, which is lessened by them.
double piece(mpfr_ptr x, mpfr_prec_t digits) {
  MpfrValue part(digits);
  mpfr_set(part, x, MPFR_RNDZ);
  mpfr_sub(x, x, part, MPFR_RNDN);
  return mpfr_get_d(part, MPFR_RNDN);
}

void make_exponentials(Constants& c) {
  MpfrValue x(bits);
  mpfr_const_log2(x, MPFR_RNDN);
  c.ln2 = rounded(x);
  mpfr_ui_div(x, 1, x, MPFR_RNDN);
  c.inverse_ln2 = rounded(x);
  c.inverse_ln2_64 = 64 * c.inverse_ln2.hi;
  mpfr_const_log2(x, MPFR_RNDN);
  mpfr_div_2ui(x, x, 6, MPFR_RNDN);
  c.ln2_64_1 = piece(x, 36);
  c.ln2_64_2 = piece(x, 53);
  c.ln2_64_3 = piece(x, 53);
  mpfr_set_ui(x, 10, MPFR_RNDN);
  mpfr_log(x, x, MPFR_RNDN);
  mpfr_ui_div(x, 1, x, MPFR_RNDN);
  c.inverse_ln10 = rounded(x);
  for (int j = -32; j <= 32; ++j) {
    const auto i = static_cast<std::size_t>(j + 32);
    mpfr_set_si_2exp(x, j, -6, MPFR_RNDN);
    mpfr_exp2(x, x, MPFR_RNDN);
    c.power[i] = rounded(x);
    mpfr_sub_ui(x, x, 1, MPFR_RNDN);
    c.power_less_1[i] = rounded(x);
  }
}

void make_angles(Constants& c) {
  MpfrValue x(bits);
  mpfr_const_pi(x, MPFR_RNDN);
  c.pi_dd = rounded(x);
  mpfr_div_2ui(x, x, 1, MPFR_RNDN);
  c.half_pi_dd = rounded(x);
  for (double& part : c.half_pi) part = piece(x, 53);
  MpfrValue cosine(bits);
  for (std::size_t i = 0; i < c.sine.size(); ++i) {
    mpfr_set_ui_2exp(x, i, -5, MPFR_RNDN);
    mpfr_sin_cos(x, cosine, x, MPFR_RNDN);
    c.sine[i] = rounded(x);
    c.cosine[i] = rounded(cosine);
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

void make_reciprocals(Constants& c) {
  MpfrValue x(bits);
  mpfr_set_ui(x, 1, MPFR_RNDN);
  for (std::size_t n = 0; n < c.inverse_factorial.size(); ++n) {
    if (n > 1) mpfr_div_ui(x, x, n, MPFR_RNDN);
    c.inverse_factorial[n] = rounded(x);
  }
  for (std::size_t n = 1; n < c.inverse.size(); ++n) {
    mpfr_set_ui(x, 1, MPFR_RNDN);
    mpfr_div_ui(x, x, n, MPFR_RNDN);
    c.inverse[n] = rounded(x);
  }
}

Constants made() {
  Constants c{};
  make_exponentials(c);
  make_angles(c);
  make_reciprocals(c);
  return c;
}

}  // namespace

const Constants& constants() {
  static const Constants c = made();
  return c;
}

}  // namespace ulpgate::dd
