// The MPFR oracle: dispatch of every row of functions.def to MPFR, MPC or a series of ours.
#include "reference/oracle/oracle.hpp"

#include "reference/oracle/oracle_angles.hpp"
#include "reference/oracle/oracle_complex.hpp"
#include "reference/oracle/oracle_erf.hpp"
#include "reference/oracle/oracle_gamma.hpp"
#include "reference/oracle/oracle_hyperbolic.hpp"
#include "reference/oracle/oracle_power.hpp"
#include "reference/oracle/oracle_special.hpp"
#include "reference/oracle/rounding_made.hpp"

namespace ulpgate {

namespace {

using oracle::complex_parts;
using oracle::exactness;
using oracle::is_finite;
using oracle::not_known;
using oracle::power;

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

// Transcendental parts.  Of z = x + iy with numbers x, y that are not 0:
// - the parts of sin, cos, sinh, cosh, exp and polar are sums of exponentials of distinct algebraic numbers,
//   none of them 0, with algebraic coefficients; by Lindemann and Weierstrass no such sum is algebraic.  A
//   part of tan or tanh that were an algebraic number would make one such sum 0;
// - the parts of the inverse functions are half-angles and logarithms of algebraic numbers, and not 0 (see
//   the formulas in oracle_complex.cpp): transcendental by the same theorem.
constexpr ExactParts transcendental = {Exactness::rounded, Exactness::rounded};

ExactParts real_part(int ternary) {
  return {exactness(ternary), Exactness::unknown};
}

ExactParts complex_parts(ExactParts parts) {
  return parts;
}

// Of a composition of MPFR's functions: where no step was rounded the value is exact.
ExactParts parts_by_flag() {
  if (mpfr_inexflag_p() != 0) return not_known;
  return {Exactness::exact, Exactness::exact};
}

// Of special functions; what an L_n^m is not can be told without its value.  J_n is transcendental at
// algebraic numbers but 0 (C. L. Siegel, "Transcendental Numbers", 1949, chapter II).
ExactParts special_parts(const FunctionInfo& f, std::span<const MpfrValue> a, mpfr_srcptr value) {
  if (f.id == FunctionId::cyl_bessel_j && mpfr_regular_p(a[1].get()) != 0)
    return {Exactness::rounded, Exactness::unknown};
  if (f.id == FunctionId::laguerre && mpfr_inexflag_p() != 0 && oracle::is_rounded_laguerre(a, value))
    return {Exactness::rounded, Exactness::unknown};
  return parts_by_flag();
}

// polar(r, t) = (r cos t, r sin t); 32 guard bits make the product's error 2^-31 ulp at most.
ExactParts polar(std::span<const MpfrValue> a, std::span<MpfrValue> out) {
  MpfrValue s(mpfr_get_prec(out[0]) + 32);
  MpfrValue c(mpfr_get_prec(out[0]) + 32);
  oracle::sine_and_cosine(s, c, a[1]);
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
  oracle::sine_and_cosine(s, c, a);
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
    return special_parts(f, a, out[0]);
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
