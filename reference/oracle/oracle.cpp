// The MPFR oracle: dispatch of every row of functions.def to MPFR, MPC or a series of ours.
#include "reference/oracle/oracle.hpp"

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <optional>

#include "reference/oracle/oracle_complex.hpp"
#include "reference/oracle/oracle_erf.hpp"
#include "reference/oracle/oracle_gamma.hpp"
#include "reference/oracle/oracle_hyperbolic.hpp"
#include "reference/oracle/oracle_special.hpp"

namespace ulpgate {

namespace {

constexpr auto nearest = MPFR_RNDN;

// logb as C99 7.12.6.11 defines it: the exponent of the binade, -inf for 0, +inf for infinities.
int exact_logb(mpfr_ptr out, mpfr_srcptr x, mpfr_rnd_t rounding) {
  if (mpfr_nan_p(x)) {
    mpfr_set_nan(out);
  } else if (mpfr_inf_p(x)) {
    mpfr_set_inf(out, 1);
  } else if (mpfr_zero_p(x)) {
    mpfr_set_inf(out, -1);
  } else {
    return mpfr_set_si(out, static_cast<long>(mpfr_get_exp(x)) - 1, rounding);
  }
  return 0;
}

int exact_erf(mpfr_ptr out, mpfr_srcptr x, mpfr_rnd_t /*nearest*/) {
  return oracle::error_function(out, x).ternary;
}

int exact_erfc(mpfr_ptr out, mpfr_srcptr x, mpfr_rnd_t /*nearest*/) {
  return oracle::complementary_error_function(out, x).ternary;
}

int exact_gamma(mpfr_ptr out, mpfr_srcptr x, mpfr_rnd_t /*nearest*/) {
  return oracle::gamma(out, x).ternary;
}

int exact_log_gamma(mpfr_ptr out, mpfr_srcptr x, mpfr_rnd_t /*nearest*/) {
  return oracle::log_gamma(out, x).ternary;
}

struct ComplexOut {
  explicit ComplexOut(std::span<MpfrValue> out) : value(mpfr_get_prec(out[0])), parts(out) {}
  ComplexOut(const ComplexOut&) = delete;
  ComplexOut& operator=(const ComplexOut&) = delete;
  ~ComplexOut() {
    mpfr_swap(parts[0], mpc_realref(static_cast<mpc_ptr>(value)));
    mpfr_swap(parts[1], mpc_imagref(static_cast<mpc_ptr>(value)));
  }
  MpcValue value;
  std::span<MpfrValue> parts;
};

// A complex argument that borrows two real ones: MPC reads its operands only, so their limbs need no copy.
struct ComplexArgument {
  ComplexArgument(mpfr_srcptr re, mpfr_srcptr im) {
    *mpc_realref(value) = *re;
    *mpc_imagref(value) = *im;
  }
  mpc_t value;
};

// What our compositions say of their parts.
constexpr ExactParts not_known = {Exactness::unknown, Exactness::unknown};

// Transcendental parts.  Of z = x + iy with numbers x, y that are not 0:
// - the parts of sin, cos, sinh, cosh, exp and polar are sums of exponentials of distinct algebraic numbers,
//   none of them 0, with algebraic coefficients; by Lindemann and Weierstrass no such sum is algebraic.  A
//   part of tan or tanh that were an algebraic number would make one such sum 0;
// - the parts of the inverse functions are half-angles and logarithms of algebraic numbers, and not 0 (see
//   the formulas in oracle_complex.cpp): transcendental by the same theorem.
constexpr ExactParts transcendental = {Exactness::rounded, Exactness::rounded};

// MPFR's ternary value is zero exactly where nothing was rounded, and has the sign of the rounding.
Exactness exactness(int ternary) {
  if (ternary == 0) return Exactness::exact;
  return ternary > 0 ? Exactness::rounded_up : Exactness::rounded_down;
}

ExactParts real_part(int ternary) {
  return {exactness(ternary), Exactness::unknown};
}

ExactParts complex_parts(int ternary) {
  return {exactness(MPC_INEX_RE(ternary)), exactness(MPC_INEX_IM(ternary))};
}
ExactParts complex_parts(ExactParts parts) {
  return parts;
}

// Of a composition of MPFR's functions: where no step was rounded the value is exact.
ExactParts parts_by_flag() {
  if (mpfr_inexflag_p() != 0) return not_known;
  return {Exactness::exact, Exactness::exact};
}

// polar(r, t) = (r cos t, r sin t); 32 guard bits make the product's error 2^-31 ulp at most.
ExactParts polar(std::span<const MpfrValue> a, std::span<MpfrValue> out) {
  MpfrValue s(mpfr_get_prec(out[0]) + 32);
  MpfrValue c(mpfr_get_prec(out[0]) + 32);
  mpfr_sin_cos(s, c, a[1], nearest);
  mpfr_mul(out[0], a[0], c, nearest);
  mpfr_mul(out[1], a[0], s, nearest);
  return mpfr_regular_p(a[0].get()) && mpfr_regular_p(a[1].get()) ? transcendental : parts_by_flag();
}

// For a + ib with `trigonometric` a and `hyperbolic` b, tan(a + ib) has the parts
//   sin a cos a / (cos^2 a + sinh^2 b)   and   sinh b cosh b / (cos^2 a + sinh^2 b)       (DLMF 4.21.40),
// products and sums without cancellation.  mpc_tan needs hours and gigabytes where one part is huge or tiny.
void tangent_parts(mpfr_ptr from_trigonometric, mpfr_ptr from_hyperbolic, mpfr_srcptr a, mpfr_srcptr b) {
  const mpfr_prec_t bits = mpfr_get_prec(from_trigonometric) + 32;
  MpfrValue s(bits), c(bits), denominator(bits);
  mpfr_sin_cos(s, c, a, nearest);
  mpfr_mul(s, s, c, nearest);
  if (mpfr_regular_p(b) && mpfr_get_exp(b) > 40) {
    // sinh^2 b = e^(2|b|)/4 to more than 2^40 bits.
    mpfr_abs(denominator, b, nearest);
    mpfr_mul_si(denominator, denominator, -2, nearest);
    mpfr_exp(denominator, denominator, nearest);
    mpfr_mul_ui(s, s, 4, nearest);
    mpfr_mul(from_trigonometric, s, denominator, nearest);
    mpfr_set_si(from_hyperbolic, mpfr_sgn(b), nearest);
    return;
  }
  MpfrValue sh(bits), ch(bits);
  oracle::sinh_and_cosh(sh, ch, b);
  mpfr_sqr(c, c, nearest);
  mpfr_sqr(denominator, sh, nearest);
  mpfr_add(denominator, denominator, c, nearest);
  mpfr_div(from_trigonometric, s, denominator, nearest);
  mpfr_mul(sh, sh, ch, nearest);
  mpfr_div(from_hyperbolic, sh, denominator, nearest);
}

bool is_finite(mpc_srcptr z) {
  return mpfr_number_p(mpc_realref(z)) != 0 && mpfr_number_p(mpc_imagref(z)) != 0;
}

// Of finite z.
ExactParts tangent_exactness(mpc_srcptr z) {
  return mpfr_zero_p(mpc_realref(z)) || mpfr_zero_p(mpc_imagref(z)) ? not_known : transcendental;
}

ExactParts tangent(mpc_ptr out, mpc_srcptr z, mpc_rnd_t rounding) {
  if (!is_finite(z)) return complex_parts(mpc_tan(out, z, rounding));
  tangent_parts(mpc_realref(out), mpc_imagref(out), mpc_realref(z), mpc_imagref(z));
  return tangent_exactness(z);
}

// tanh z = -i tan(iz): the parts of z change their roles.
ExactParts hyperbolic_tangent(mpc_ptr out, mpc_srcptr z, mpc_rnd_t rounding) {
  if (!is_finite(z)) return complex_parts(mpc_tanh(out, z, rounding));
  tangent_parts(mpc_imagref(out), mpc_realref(out), mpc_imagref(z), mpc_realref(z));
  return tangent_exactness(z);
}

long exponent_of(mpfr_srcptr x) {
  return mpfr_regular_p(x) ? static_cast<long>(mpfr_get_exp(x)) : 0L;
}

// arg z in units of pi/4 where z lies on an axis or a diagonal; -pi below the cut, at -x - 0i.
std::optional<int> eighths_of_turn(mpc_srcptr z) {
  const int re = mpfr_sgn(mpc_realref(z));
  const int im = mpfr_sgn(mpc_imagref(z));
  if (re != 0 && im != 0 && mpfr_cmpabs(mpc_realref(z), mpc_imagref(z)) != 0) return std::nullopt;
  if (re > 0) return im;
  if (im == 0) return mpfr_signbit(mpc_imagref(z)) != 0 ? -4 : 4;
  return re == 0 ? 2 * im : 3 * im;
}

bool is_of_modulus_one(mpc_srcptr z) {
  MpfrValue norm(2 * std::max(mpfr_get_prec(mpc_realref(z)), mpfr_get_prec(mpc_imagref(z))));
  return mpc_norm(norm, z, nearest) == 0 && mpfr_cmp_ui(norm, 1) == 0;
}

// |z^w| (cos t + i sin t) where t is the exact multiple Re(w) eighths of pi/4, so that exact zeros are zeros.
void power_by_turns(mpc_ptr out, mpc_srcptr log_power, mpfr_srcptr re_w, int eighths) {
  MpfrValue half_turns(mpfr_get_prec(re_w) + 4);
  mpfr_mul_si(half_turns, re_w, eighths, nearest);
  mpfr_div_2ui(half_turns, half_turns, 2, nearest);
  MpfrValue modulus(mpc_get_prec(log_power));
  MpfrValue direction(mpc_get_prec(log_power));
  mpfr_exp(modulus, mpc_realref(log_power), nearest);
  const auto set_part = [&](mpfr_ptr part) {
    // A modulus beyond the range does not make an exact zero undefined.
    if (mpfr_zero_p(direction)) {
      mpfr_set(part, direction, nearest);
    } else {
      mpfr_mul(part, modulus, direction, nearest);
    }
  };
  mpfr_cospi(direction, half_turns, nearest);
  set_part(mpc_realref(out));
  mpfr_sinpi(direction, half_turns, nearest);
  set_part(mpc_imagref(out));
}

// ln|z|, with all of its bits next to |z| = 1 as well: there of |z|^2 - 1 = (l - 1)(l + 1) + s^2, l the
// larger part.
void log_modulus(mpfr_ptr out, mpc_srcptr z) {
  mpfr_srcptr l = mpc_realref(z);
  mpfr_srcptr s = mpc_imagref(z);
  if (mpfr_cmpabs(l, s) < 0) std::swap(l, s);
  if (exponent_of(l) == 0 || exponent_of(l) == 1) {
    MpfrValue size(mpfr_get_prec(l)), below(mpfr_get_prec(l) + 2), above(mpfr_get_prec(l) + 2);
    mpfr_abs(size, l, nearest);
    mpfr_sub_ui(below, size, 1, nearest);
    mpfr_add_ui(above, size, 1, nearest);
    mpfr_fmma(out, below, above, s, s, nearest);
    if (mpfr_zero_p(out) || exponent_of(out) <= -1) {
      mpfr_log1p(out, out, nearest);
      mpfr_div_2ui(out, out, 1, nearest);
      return;
    }
  }
  mpfr_hypot(out, mpc_realref(z), mpc_imagref(z), nearest);
  mpfr_log(out, out, nearest);
}

// w log z with an absolute error of 2^(-bits - spared_bits()), but for the exponent of log z: of its
// imaginary part always, of its real part below 2^64; beyond that a power is beyond MPFR's range, whatever
// the rest of it.
class PowerLogarithm {
 public:
  // `least` more bits of both ln|z| and arg z in any case.
  PowerLogarithm(mpc_srcptr z, mpc_srcptr w, long bits, long least)
      : re_(exponent_of(mpc_realref(w))),
        im_(exponent_of(mpc_imagref(w))),
        of_log_(std::max({im_, std::min(re_, ordinary), least, 0L})),
        of_arg_(std::max({re_, std::min(im_, ordinary), least, 0L})),
        bits_(bits),
        value_(bits + std::max({re_, im_, 0L}) + ordinary) {
    MpfrValue log(bits + of_log_);
    MpfrValue arg(bits + of_arg_);
    log_modulus(log, z);
    mpfr_atan2(arg, mpc_imagref(z), mpc_realref(z), nearest);
    mpfr_fmms(mpc_realref(value()), mpc_realref(w), log, mpc_imagref(w), arg, nearest);
    mpfr_fmma(mpc_imagref(value()), mpc_realref(w), arg, mpc_imagref(w), log, nearest);
    // A term that is 0 is off by nothing.
    if (mpfr_regular_p(mpc_realref(w)) && mpfr_regular_p(log.get()))
      real_error_ = re_ + exponent_of(log) - of_log_ + 3 - bits;
    if (mpfr_regular_p(mpc_imagref(w)) && mpfr_regular_p(arg.get()))
      real_error_ = std::max(real_error_, im_ + exponent_of(arg) - of_arg_ + 3 - bits);
  }
  [[nodiscard]] mpc_ptr value() { return value_; }
  // Of a small w the error is as small.
  [[nodiscard]] long spared_bits() const { return std::max(0L, -std::max(re_, im_)); }
  // Of the parts of the power, whose real part was rounded to `re`: whether 1 is the exact value, and on
  // which side of it that lies.  It is 1 + d, d = p - q^2/2, but for the squares and the product of these two
  // terms.
  [[nodiscard]] ExactParts exactness(mpfr_srcptr re) {
    if (mpfr_cmp_ui(re, 1) != 0) return not_known;
    constexpr long bits = 160;
    mpfr_srcptr p = mpc_realref(value());
    MpfrValue d(bits);
    MpfrValue half_square(bits);
    mpfr_sqr(half_square, mpc_imagref(value()), nearest);
    mpfr_div_2ui(half_square, half_square, 1, nearest);
    mpfr_sub(d, p, half_square, nearest);
    if (!mpfr_regular_p(d.get())) return not_known;
    long terms = exponent_of(d);
    if (mpfr_regular_p(p)) terms = std::max(terms, exponent_of(p));
    if (mpfr_regular_p(half_square.get())) terms = std::max(terms, exponent_of(half_square));
    // Of itself q is known as well as p is.
    if (exponent_of(d) <= std::max({terms - bits + 8, 2 * terms + 4, real_error_ + 3})) return not_known;
    return {mpfr_sgn(d.get()) < 0 ? Exactness::rounded_up : Exactness::rounded_down, Exactness::unknown};
  }
  // Whether the real part is not known well enough, which then has cancelled.
  [[nodiscard]] bool is_vague() {
    const long lacking = std::max(re_ - of_log_, im_ - of_arg_);
    // |log z| is below 2^64.
    return lacking > 0 && exponent_of(mpc_realref(value())) <= std::max(lacking - bits_ + 80, ordinary);
  }

 private:
  static constexpr long ordinary = 64;
  long re_;
  long im_;
  long of_log_;
  long of_arg_;
  long bits_;
  long real_error_ =
      std::numeric_limits<long>::min() / 2;  // exponent of what the real part is off by at most
  MpcValue value_;
};

// z^w = exp(w log z).  MPC's own power searches for exact results without end in sight where w is complex or
// large; it serves where w is a small half integer.
ExactParts power(mpc_ptr out, mpc_srcptr z, mpc_srcptr w, mpc_rnd_t rounding) {
  const long size = std::max({exponent_of(mpc_realref(w)), exponent_of(mpc_imagref(w)), 0L});
  const bool zero = mpfr_zero_p(mpc_realref(z)) && mpfr_zero_p(mpc_imagref(z));
  MpfrValue twice(mpfr_get_prec(mpc_realref(w)));
  mpfr_mul_ui(twice, mpc_realref(w), 2, nearest);
  const bool half_integer = mpfr_zero_p(mpc_imagref(w)) && size <= 10 && mpfr_integer_p(twice);
  if (zero || half_integer || !is_finite(z) || !is_finite(w))
    return complex_parts(mpc_pow(out, z, w, rounding));

  // The angle Re(w) arg(z) + Im(w) ln|z|: without its second term it may be an exact multiple of pi/4.
  const bool one_term = mpfr_zero_p(mpc_imagref(w)) || is_of_modulus_one(z);
  const auto eighths = one_term ? eighths_of_turn(z) : std::nullopt;
  const mpfr_prec_t precision = mpfr_get_prec(mpc_realref(out));
  // Where the angle comes close to a multiple of pi/2 its sine or cosine loses as many bits; they are added
  // until they suffice, for a part beyond MPFR's range as well, which is nothing but its sign.  Neither is
  // exactly zero here, but a limit must stand.
  constexpr long most_guard_bits = 1L << 16U;
  // Each of ln|z| and arg z has the bits that the angle asks of it, and of an ordinary modulus.
  bool all_bits = false;
  for (long guard = 112;;) {
    PowerLogarithm log_power(z, w, precision + guard, all_bits ? size : 0);
    if (log_power.is_vague()) {
      all_bits = true;
      continue;
    }
    if (eighths) {
      power_by_turns(out, log_power.value(), mpc_realref(w), *eighths);
      return log_power.exactness(mpc_realref(out));
    }
    MpfrValue sine(precision + 32);
    MpfrValue cosine(precision + 32);
    mpfr_sin_cos(sine, cosine, mpc_imagref(log_power.value()), nearest);
    const long lost = -std::min(exponent_of(sine), exponent_of(cosine));
    // |log z| needs up to 12 bits before its point for binary64's exponents, 64 for any.
    const long lacking = lost - log_power.spared_bits();
    if (lacking + 80 > guard && guard < most_guard_bits) {
      guard = std::min(lacking + 160, most_guard_bits);
      continue;
    }
    MpfrValue modulus(precision + 32);
    mpfr_exp(modulus, mpc_realref(log_power.value()), nearest);
    mpfr_mul(mpc_realref(out), modulus, cosine, nearest);
    mpfr_mul(mpc_imagref(out), modulus, sine, nearest);
    return log_power.exactness(mpc_realref(out));
  }
}

ExactParts evaluate(const FunctionInfo& f, std::span<const MpfrValue> a, std::span<MpfrValue> out) {
  if (f.function_class == FunctionClass::complex && oracle::complex_value(f, a, out)) return transcendental;
  switch (f.id) {
#define REAL1(name, d0, hard, call) \
  case FunctionId::name:            \
    return real_part(call(out[0], a[0], nearest));
#define REAL2(name, d0, d1, hard, call) \
  case FunctionId::name:                \
    return real_part(call(out[0], a[0], a[1], nearest));
#define OPER2(name, op, d0, d1, hard, call) REAL2(name, d0, d1, hard, call)
#define REAL3(name, d0, d1, d2, hard, call) \
  case FunctionId::name:                    \
    return real_part(call(out[0], a[0], a[1], a[2], nearest));
#define COMPLEX1(token, callee, call)                        \
  case FunctionId::token: {                                  \
    const ComplexArgument z(a[0], a[1]);                     \
    ComplexOut w(out);                                       \
    return complex_parts(call(w.value, z.value, MPC_RNDNN)); \
  }
#define COMPLEX2(token, callee, call)                                 \
  case FunctionId::token: {                                           \
    const ComplexArgument z(a[0], a[1]);                              \
    const ComplexArgument y(a[2], a[3]);                              \
    ComplexOut w(out);                                                \
    return complex_parts(call(w.value, z.value, y.value, MPC_RNDNN)); \
  }
#define COMPLEX_REAL(token, callee, call)             \
  case FunctionId::token: {                           \
    const ComplexArgument z(a[0], a[1]);              \
    return real_part(call(out[0], z.value, nearest)); \
  }
#define POLAR(token, callee) \
  case FunctionId::token:    \
    return polar(a, out);
#define SPECIAL1(token, d0) \
  case FunctionId::token:   \
    oracle::token(a, out);  \
    return parts_by_flag();
#define SPECIAL2(token, d0, d1, hard) SPECIAL1(token, d0)
#define SPECIAL3(token, d0, d1, d2) SPECIAL1(token, d0)
#define SPECIAL4_COMPLEX(token, d0, d1, d2, d3) SPECIAL1(token, d0)
#include "reference/functions/functions.def"
  }
  return not_known;
}

}  // namespace

ExactParts exact_value(const FunctionInfo& f, std::span<const MpfrValue> args, std::span<MpfrValue> out) {
  const WideExponentRange wide;
  mpfr_clear_inexflag();
  return evaluate(f, args, out);
}

}  // namespace ulpgate
