// Sines of huge angles and arguments of complex numbers.
#include "reference/oracle/oracle_angles.hpp"

#include <cmath>

#include "reference/types/mpfr_value.hpp"

namespace ulpgate::oracle {

namespace {

constexpr auto nearest = MPFR_RNDN;

// Below this exponent MPFR's own reduction has a few words more to divide; above the last one the bits of
// 2/pi are too many to keep.
constexpr mpfr_exp_t least_far = 200;
constexpr mpfr_exp_t greatest_far = mpfr_exp_t{1} << 20U;

// Bits of 2/pi behind the point, of this thread.
class TwoOverPi {
 public:
  // out = floor(2/pi 2^bits), or one less.
  void first(mpz_ptr out, long bits) {
    if (bits > have_) {
      have_ = bits + bits / 2;
      MpfrValue quotient(have_ + 16);
      mpfr_const_pi(quotient, nearest);
      mpfr_ui_div(quotient, 2, quotient, nearest);
      mpfr_mul_2si(quotient, quotient, have_, nearest);
      mpfr_get_z(all_, quotient, MPFR_RNDD);
    }
    mpz_fdiv_q_2exp(out, all_, static_cast<mp_bitcnt_t>(have_ - bits));
  }

 private:
  long have_ = 0;
  MpzValue all_;
};

// x = (4k + quadrant) pi/2 + r with a whole k and |r| <= pi/4, r within 2^-bits and its own rounding.
unsigned reduce(mpfr_ptr r, mpfr_srcptr x, long bits) {
  static thread_local TwoOverPi two_over_pi;
  MpzValue m;
  const mpfr_exp_t exponent = mpfr_get_z_2exp(m, x);
  const bool negative = mpz_sgn(static_cast<mpz_srcptr>(m)) < 0;
  mpz_abs(m, m);
  // Of 2^exponent 2/pi what lies above 4 is whole turns of any whole m.  It is off by two units, so that the
  // product is off by 2^-bits/2 of a quarter turn.
  const long behind = bits + static_cast<long>(mpz_sizeinbase(m, 2)) + 2;
  MpzValue turns;
  two_over_pi.first(turns, exponent + behind);
  const auto point = static_cast<mp_bitcnt_t>(behind);
  mpz_fdiv_r_2exp(turns, turns, point + 2);
  mpz_mul(turns, turns, m);
  mpz_fdiv_r_2exp(turns, turns, point + 2);
  MpzValue quarters;
  mpz_fdiv_q_2exp(quarters, turns, point);
  auto quadrant = static_cast<unsigned>(mpz_get_ui(quarters));
  mpz_fdiv_r_2exp(turns, turns, point);
  if (mpz_tstbit(turns, point - 1) != 0) {
    MpzValue one_turn;
    mpz_setbit(one_turn, point);
    mpz_sub(turns, turns, one_turn);
    ++quadrant;
  }
  MpfrValue half_pi(mpfr_get_prec(r));
  mpfr_const_pi(half_pi, nearest);
  mpfr_div_2ui(half_pi, half_pi, 1, nearest);
  mpfr_set_z_2exp(r, turns, -behind, nearest);
  mpfr_mul(r, r, half_pi, nearest);
  if (negative) {
    mpfr_neg(r, r, nearest);
    quadrant = 0U - quadrant;
  }
  return quadrant % 4;
}

// atan t of |t| < 2^-19, by its series.
void small_arc_tangent(mpfr_ptr out, mpfr_srcptr t) {
  const mpfr_prec_t bits = mpfr_get_prec(out);
  MpfrValue square(bits), power(bits), term(bits);
  mpfr_sqr(square, t, nearest);
  mpfr_set(power, t, nearest);
  mpfr_set(out, t, nearest);
  for (unsigned long odd = 3; mpfr_regular_p(power.get()) != 0; odd += 2) {
    mpfr_mul(power, power, square, nearest);
    mpfr_div_ui(term, power, odd, nearest);
    if (mpfr_get_exp(term.get()) < mpfr_get_exp(out) - static_cast<mpfr_exp_t>(bits) - 2) return;
    if (odd % 4 == 3) {
      mpfr_sub(out, out, term, nearest);
    } else {
      mpfr_add(out, out, term, nearest);
    }
  }
}

// atan(y / x) of |y| <= x.
void arc_tangent_of_ratio(mpfr_ptr out, mpfr_srcptr y, mpfr_srcptr x) {
  const mpfr_prec_t bits = mpfr_get_prec(out);
  MpfrValue ratio(bits);
  if (mpfr_get_exp(y) < mpfr_get_exp(x) - 20) {
    mpfr_div(ratio, y, x, nearest);
    return small_arc_tangent(out, ratio);
  }
  // atan(y / x) = t + atan((y cos t - x sin t) / (x cos t + y sin t)) of any t.  Rounded sines are off by
  // 2^-bits of t, and so is the first difference, divided by x.
  mpfr_set_prec(ratio, 53);
  mpfr_div(ratio, y, x, nearest);
  const double first = std::atan(mpfr_get_d(ratio, nearest));
  mpfr_set_d(ratio, first, nearest);
  MpfrValue s(bits), c(bits), rest(bits);
  mpfr_sin_cos(s, c, ratio, nearest);
  mpfr_fmms(rest, y, c, x, s, nearest);
  mpfr_fmma(c, x, c, y, s, nearest);
  mpfr_div(rest, rest, c, nearest);
  small_arc_tangent(out, rest);
  mpfr_add_d(out, out, first, nearest);
}

}  // namespace

bool reduce_to_quadrant(unsigned& quadrant, mpfr_ptr r, mpfr_srcptr x, long bits) {
  if (mpfr_regular_p(x) != 0 && mpfr_get_exp(x) > greatest_far) return false;
  if (mpfr_regular_p(x) == 0 || mpfr_get_exp(x) < 0) {
    quadrant = 0;
    mpfr_set(r, x, nearest);
  } else {
    quadrant = reduce(r, x, bits);
  }
  return true;
}

void sine_and_cosine(mpfr_ptr s, mpfr_ptr c, mpfr_srcptr x) {
  if (mpfr_regular_p(x) == 0 || mpfr_get_exp(x) < least_far || mpfr_get_exp(x) > greatest_far) {
    mpfr_sin_cos(s, c, x, nearest);
    return;
  }
  const mpfr_prec_t precision = mpfr_get_prec(s);
  MpfrValue r(precision + 16);
  long bits = precision + 32;
  unsigned quadrant = reduce(r, x, bits);
  // Next to a multiple of pi/2, which x never is, the sine or cosine has the error relative to r.
  while (mpfr_regular_p(r.get()) == 0 || bits + mpfr_get_exp(r.get()) < precision + 8) {
    bits += mpfr_regular_p(r.get()) != 0 ? 16 - mpfr_get_exp(r.get()) : bits;
    quadrant = reduce(r, x, bits);
  }
  mpfr_sin_cos(s, c, r, nearest);
  if (quadrant % 2 == 1) mpfr_swap(s, c);
  if (quadrant == 2 || quadrant == 3) mpfr_neg(s, s, nearest);
  if (quadrant == 1 || quadrant == 2) mpfr_neg(c, c, nearest);
}

void angle_of(mpfr_ptr out, mpfr_srcptr y, mpfr_srcptr x) {
  if (mpfr_regular_p(x) == 0 || mpfr_regular_p(y) == 0) {
    mpfr_atan2(out, y, x, nearest);
    return;
  }
  // Of the quarter turn around the axis that is next to it.
  const bool steep = mpfr_cmpabs(y, x) > 0;
  mpfr_srcptr along = steep ? y : x;
  mpfr_srcptr across = steep ? x : y;
  const mpfr_prec_t bits = mpfr_get_prec(out) + 16;
  MpfrValue size(mpfr_get_prec(along)), angle(bits);
  mpfr_abs(size, along, nearest);
  arc_tangent_of_ratio(angle, across, size);
  if (!steep && mpfr_sgn(x) > 0) {
    mpfr_set(out, angle, nearest);
    return;
  }
  // arg = pi/2 - atan(x/y) above, -pi/2 + atan(x/|y|) below, +-pi - atan(y/|x|) to the left.
  MpfrValue axis(bits);
  mpfr_const_pi(axis, nearest);
  if (steep) mpfr_div_2ui(axis, axis, 1, nearest);
  const bool below = mpfr_sgn(y) < 0;
  if (steep && below) mpfr_neg(angle, angle, nearest);
  if (below) mpfr_neg(axis, axis, nearest);
  mpfr_sub(out, axis, angle, nearest);
}

}  // namespace ulpgate::oracle
